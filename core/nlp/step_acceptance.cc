#include "core/nlp/step_acceptance.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

// Names as in Wächter and Biegler, values as in Ipopt.
constexpr double kGammaTheta = 1e-5, kGammaPhi = 1e-8, kDelta = 1, kSTheta = 1.1, kSPhi = 2.3, kEtaPhi = 1e-8;
constexpr double kGammaAlpha = 0.05;

// a ≤ b up to the rounding of numbers of the size of `scale`.
bool AtMost(double a, double b, double scale) {
  constexpr double kEpsilon = 2.2e-16;
  return a - b <= 10 * kEpsilon * std::abs(scale);
}

// Whether φ is expected to fall by so much that it, and not θ, is to be judged.
bool Switching(const LinePoint& from, double alpha) {
  return from.slope < 0 && alpha * std::pow(-from.slope, kSPhi) > kDelta * std::pow(from.theta, kSTheta);
}

bool Armijo(const LinePoint& from, double alpha, double phi) {
  return AtMost(phi - from.phi, kEtaPhi * alpha * from.slope, from.phi);
}

}  // namespace

void StepAcceptance::Begin(double first_theta) {
  theta_min_ = 1e-4 * std::max(1.0, first_theta);
  theta_max_ = 1e4 * std::max(1.0, first_theta);
  ForgetFilter();
}

void StepAcceptance::Restore(const Memory& memory) {
  theta_min_ = memory.theta_min;
  theta_max_ = memory.theta_max;
  ForgetFilter();
  filter_.SetCorners(memory.corners);
}

bool StepAcceptance::Accepts(const LinePoint& from, double alpha, const LinePoint& to) {
  if (!std::isfinite(to.phi) || to.theta > theta_max_) return false;
  if (Switching(from, alpha) && from.theta <= theta_min_) {
    if (!Armijo(from, alpha, to.phi)) return false;
  } else {
    // An objective that grows by orders of magnitude is not paid for by a little feasibility.
    if (to.phi > from.phi &&
        std::log10(to.phi - from.phi) > 5 + std::max(1.0, std::log10(std::max(10.0, std::abs(from.phi))))) {
      return false;
    }
    if (!AtMost(to.theta, (1 - kGammaTheta) * from.theta, from.theta) &&
        !AtMost(to.phi - from.phi, -kGammaPhi * from.theta, from.phi)) {
      return false;
    }
  }
  if (!filter_.Accepts(to.theta, to.phi)) return false;
  if (!Switching(from, alpha) || !Armijo(from, alpha, to.phi)) Exclude(from);
  return true;
}

void StepAcceptance::Exclude(const LinePoint& point) {
  filter_.Add((1 - kGammaTheta) * point.theta, point.phi - kGammaPhi * point.theta);
}

bool StepAcceptance::TakesFromAnywhere(const LinePoint& point) const {
  return std::isfinite(point.phi) && point.theta <= theta_max_ && filter_.Accepts(point.theta, point.phi);
}

double StepAcceptance::SmallestStep(const LinePoint& from) const {
  double least = kGammaTheta;
  if (from.slope < 0) {
    least = std::min(least, kGammaPhi * from.theta / -from.slope);
    if (from.theta <= theta_min_) {
      least = std::min(least, kDelta * std::pow(from.theta, kSTheta) / std::pow(-from.slope, kSPhi));
    }
  }
  return kGammaAlpha * least;
}

}  // namespace rollgait
