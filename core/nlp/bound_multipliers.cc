#include "core/nlp/bound_multipliers.h"

#include <algorithm>

#include "core/nlp/step_length.h"

namespace rollgait {
namespace {

constexpr double kKappaSigma = 1e10;

}  // namespace

void StartBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& point, double mu,
                           const NlpStart& start, bool estimate, Multipliers* multipliers) {
  const int n = barrier.variables();
  const bool warm = start.constraint_multipliers.size() > 0;
  multipliers->lower.setZero(barrier.unknowns());
  multipliers->upper.setZero(barrier.unknowns());
  for (int i = 0; i < barrier.unknowns(); ++i) {
    const double row = warm && i >= n ? multipliers->y(barrier.slack_rows()[i - n]) : 0;
    const auto first = [&](double given, double distance) {
      return warm || estimate ? std::max(given, mu / distance) : 1.0;
    };
    if (barrier.has_lower(i)) {
      const double given = warm && i < n ? start.lower_bound_multipliers(i) : -row;
      multipliers->lower(i) = first(given, point.w(i) - barrier.lower(i));
    }
    if (barrier.has_upper(i)) {
      const double given = warm && i < n ? start.upper_bound_multipliers(i) : row;
      multipliers->upper(i) = first(given, barrier.upper(i) - point.w(i));
    }
  }
}

void StepBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                          const Multipliers& multipliers, const VectorX& move, double mu, Multipliers* step) {
  step->lower.setZero(barrier.unknowns());
  step->upper.setZero(barrier.unknowns());
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.has_lower(i)) {
      step->lower(i) = MultiplierStep(point.w(i) - barrier.lower(i), multipliers.lower(i), move(i), mu);
    }
    if (barrier.has_upper(i)) {
      step->upper(i) = MultiplierStep(barrier.upper(i) - point.w(i), multipliers.upper(i), -move(i), mu);
    }
  }
}

void MoveBoundMultipliers(const BarrierProblem& barrier, const BarrierProblem::Point& from,
                          const BarrierProblem::Point& to, double mu, double tau, double most,
                          Multipliers* multipliers) {
  Multipliers step;
  StepBoundMultipliers(barrier, from, *multipliers, to.w - from.w, mu, &step);
  const double alpha = MaxDualStep(*multipliers, step, tau);
  multipliers->lower += alpha * step.lower;
  multipliers->upper += alpha * step.upper;
  if (std::max(multipliers->lower.lpNorm<Eigen::Infinity>(), multipliers->upper.lpNorm<Eigen::Infinity>()) <= most) {
    return;
  }
  for (int i = 0; i < barrier.unknowns(); ++i) {
    multipliers->lower(i) = barrier.has_lower(i) ? 1 : 0;
    multipliers->upper(i) = barrier.has_upper(i) ? 1 : 0;
  }
}

double NearCentralPath(double distance, double z, double mu) {
  return std::clamp(z, mu / (kKappaSigma * distance), kKappaSigma * mu / distance);
}

void KeepNearCentralPath(const BarrierProblem& barrier, const BarrierProblem::Point& point, double mu,
                         Multipliers* multipliers) {
  for (int i = 0; i < barrier.unknowns(); ++i) {
    double& lower = multipliers->lower(i);
    double& upper = multipliers->upper(i);
    if (barrier.has_lower(i)) lower = NearCentralPath(point.w(i) - barrier.lower(i), lower, mu);
    if (barrier.has_upper(i)) upper = NearCentralPath(barrier.upper(i) - point.w(i), upper, mu);
  }
}

}  // namespace rollgait
