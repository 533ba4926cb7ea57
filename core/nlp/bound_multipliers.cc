#include "core/nlp/bound_multipliers.h"

#include <algorithm>

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

void KeepNearCentralPath(const BarrierProblem& barrier, const BarrierProblem::Point& point, double mu,
                         Multipliers* multipliers) {
  const auto within = [mu](double z, double distance) {
    return std::clamp(z, mu / (kKappaSigma * distance), kKappaSigma * mu / distance);
  };
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.has_lower(i)) multipliers->lower(i) = within(multipliers->lower(i), point.w(i) - barrier.lower(i));
    if (barrier.has_upper(i)) multipliers->upper(i) = within(multipliers->upper(i), barrier.upper(i) - point.w(i));
  }
}

}  // namespace rollgait
