#include "core/nlp/step_length.h"

#include <algorithm>
#include <cmath>

namespace rollgait {

double MaxPrimalStep(const BarrierProblem& barrier, const BarrierProblem::Point& point, const VectorX& step,
                     double tau) {
  double alpha = 1;
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (step(i) < 0 && barrier.has_lower(i)) {
      alpha = std::min(alpha, tau * (point.w(i) - barrier.lower(i)) / -step(i));
    } else if (step(i) > 0 && barrier.has_upper(i)) {
      alpha = std::min(alpha, tau * (barrier.upper(i) - point.w(i)) / step(i));
    }
  }
  return alpha;
}

bool IsTiny(const VectorX& step, const BarrierProblem::Point& point) {
  constexpr double kEpsilon = 2.2e-16;
  for (int i = 0; i < step.size(); ++i) {
    if (std::abs(step(i)) > 10 * kEpsilon * (1 + std::abs(point.w(i)))) return false;
  }
  return point.theta < 1e-4;
}

double MaxPositiveStep(const VectorX& value, const VectorX& step, double tau) {
  double alpha = 1;
  for (int i = 0; i < step.size(); ++i) {
    if (step(i) < 0) alpha = std::min(alpha, tau * value(i) / -step(i));
  }
  return alpha;
}

double MaxDualStep(const Multipliers& multipliers, const Multipliers& step, double tau) {
  return std::min(MaxPositiveStep(multipliers.lower, step.lower, tau),
                  MaxPositiveStep(multipliers.upper, step.upper, tau));
}

}  // namespace rollgait
