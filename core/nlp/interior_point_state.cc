#include "core/nlp/interior_point_state.h"

#include <cmath>

namespace rollgait {
namespace {

// NaN is no positive number.
bool IsPositive(double value) { return value > 0 && std::isfinite(value); }

bool IsInside(const InteriorPointState& state, const BarrierProblem& barrier) {
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.has_lower(i) &&
        !(IsPositive(state.w(i) - barrier.lower(i)) && IsPositive(state.multipliers.lower(i)))) {
      return false;
    }
    if (barrier.has_upper(i) &&
        !(IsPositive(barrier.upper(i) - state.w(i)) && IsPositive(state.multipliers.upper(i)))) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool Fits(const InteriorPointState& state, NlpProblem& problem, const NlpOptions& options) {
  BarrierProblem barrier(problem, options.BoundRelaxation());
  const Multipliers& multipliers = state.multipliers;
  if (state.w.size() != barrier.unknowns() || multipliers.y.size() != barrier.rows() ||
      multipliers.lower.size() != barrier.unknowns() || multipliers.upper.size() != barrier.unknowns()) {
    return false;
  }
  if (!state.w.allFinite() || !multipliers.y.allFinite() || !multipliers.lower.allFinite() ||
      !multipliers.upper.allFinite()) {
    return false;
  }
  if (state.iteration < 0 || !(state.elapsed_s >= 0) || !IsPositive(state.barrier.mu) ||
      !(state.barrier.recent_step >= 0 && state.barrier.recent_step <= 1) || state.barrier.raised < 0 ||
      state.tiny_steps < 0 || !IsPositive(state.acceptance.theta_min) || !IsPositive(state.acceptance.theta_max) ||
      !(state.newton.last_shift >= 0) || state.newton.zero_failures < 0 || state.newton.skipped < 0 ||
      !(state.newton.threshold > 0 && state.newton.threshold <= 0.5)) {
    return false;
  }
  if (!barrier.MoveBounds(state.moved_bounds) || !IsInside(state, barrier)) return false;
  BarrierProblem::Point point;
  point.w = state.w;
  point.c.resize(barrier.rows());
  return barrier.Evaluate(&point);
}

}  // namespace rollgait
