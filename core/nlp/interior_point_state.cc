#include "core/nlp/interior_point_state.h"

#include <cmath>

namespace rollgait {
namespace {

// NaN is no positive number.
bool IsPositive(double value) { return value > 0 && std::isfinite(value); }

// Of w and its multipliers: sizes and numbers.
bool AreFinite(const VectorX& w, const Multipliers& multipliers, const BarrierProblem& barrier) {
  return w.size() == barrier.unknowns() && multipliers.y.size() == barrier.rows() &&
         multipliers.lower.size() == barrier.unknowns() && multipliers.upper.size() == barrier.unknowns() &&
         w.allFinite() && multipliers.y.allFinite() && multipliers.lower.allFinite() && multipliers.upper.allFinite();
}

// And whether w is within the bounds, and the functions have values there.
bool IsInside(const VectorX& w, const Multipliers& multipliers, BarrierProblem& barrier) {
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.has_lower(i) && !(IsPositive(w(i) - barrier.lower(i)) && IsPositive(multipliers.lower(i)))) {
      return false;
    }
    if (barrier.has_upper(i) && !(IsPositive(barrier.upper(i) - w(i)) && IsPositive(multipliers.upper(i)))) {
      return false;
    }
  }
  BarrierProblem::Point point;
  point.w = w;
  point.c.resize(barrier.rows());
  return barrier.Evaluate(&point);
}

bool ArePositive(const ElasticVariables& elastic, const BarrierProblem& barrier) {
  for (const VectorX* part : {&elastic.p, &elastic.n, &elastic.z_p, &elastic.z_n}) {
    if (part->size() != barrier.rows() || !part->allFinite()) return false;
  }
  VectorX least = elastic.p.cwiseMin(elastic.n).cwiseMin(elastic.z_p).cwiseMin(elastic.z_n);
  for (const int row : barrier.free_rows()) least(row) = 1;
  return (least.array() > 0).all();
}

// What an interior point method remembers, whichever problem it is applied to.
bool CanBe(const BarrierParameter::Memory& barrier, const StepAcceptance::Memory& acceptance,
           const NewtonSystem::Memory& newton) {
  return IsPositive(barrier.mu) && barrier.recent_step >= 0 && barrier.recent_step <= 1 && barrier.raised >= 0 &&
         IsPositive(acceptance.theta_min) && IsPositive(acceptance.theta_max) && newton.last_shift >= 0 &&
         newton.zero_failures >= 0 && newton.skipped >= 0 && newton.threshold > 0 && newton.threshold <= 0.5;
}

}  // namespace

bool Fits(const InteriorPointState& state, NlpProblem& problem, const NlpOptions& options) {
  BarrierProblem barrier(problem, options.BoundRelaxation());
  if (state.iteration < 0 || !(state.elapsed_s >= 0) || state.tiny_steps < 0) return false;
  if (!CanBe(state.barrier, state.acceptance, state.newton)) return false;
  if (!AreFinite(state.w, state.multipliers, barrier) || !barrier.MoveBounds(state.moved_bounds)) return false;
  if (!IsInside(state.w, state.multipliers, barrier)) return false;
  if (!state.restoration) return true;
  const RestorationState& phase = *state.restoration;
  return CanBe(phase.barrier, phase.acceptance, phase.newton) && AreFinite(phase.w, phase.multipliers, barrier) &&
         ArePositive(phase.elastic, barrier) && IsInside(phase.w, phase.multipliers, barrier);
}

}  // namespace rollgait
