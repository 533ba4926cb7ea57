#ifndef ROLLGAIT_CORE_OCP_COSTS_POWER_PRICE_H_
#define ROLLGAIT_CORE_OCP_COSTS_POWER_PRICE_H_

#include <cmath>

#include "core/base/check.h"

namespace rollgait {

// Energy per time that a power P, W, takes: c⁺ P of work that is done, c⁻ |P| of work that is taken up, c > 0, with the
// corner at P = 0 made round by ε > 0, W:
//   E(P) = c (√(P² − 2tεP + ε²) − ε + tP),  c = (c⁺ + c⁻)/2,  t = (c⁺ − c⁻)/(c⁺ + c⁻).
// E is convex, zero with a zero slope at P = 0, positive elsewhere, and never above the energy with the corner; far
// from zero it is that of a power smaller by ε: c⁺(P − ε), c⁻(|P| − ε). Of equal prices it is c (√(P² + ε²) − ε). The
// hyperbola is tilted about its lowest point: tilting c (√(P² + ε²) − ε) by the line c t P instead would pay for slow
// absorption, 0.6 ε a joint with the efficiencies of muscles. Immutable value.
class PowerPrice {
 public:
  PowerPrice(double positive, double negative, double smoothing)
      : positive_(positive),
        negative_(negative),
        mean_((positive + negative) / 2),
        tilt_((positive - negative) / (positive + negative)),
        smoothing_(smoothing) {
    ROLLGAIT_CHECK(positive > 0 && negative > 0 && smoothing > 0);
    upright_ = 4 * positive * negative / ((positive + negative) * (positive + negative));
  }

  // E and its first two derivatives by P.
  struct Jet {
    double value, first, second;
  };
  Jet At(double power) const {
    // Without cancellation: ρ² = P² − 2tεP + ε² = (ε − tP)² + (1 − t²)P², so that ρ − (ε − tP) is the second summand
    // over ρ + (ε − tP).
    const double rest = smoothing_ - tilt_ * power, height = upright_ * power * power;
    const double root = std::sqrt(rest * rest + height);
    const double excess = rest > 0 ? height / (root + rest) : root - rest;
    // E' = c ((P − tε)/ρ + t) = c ((1 − t²)P + t E/c)/ρ, as tρ = t(E/c) + t(ε − tP).
    return {mean_ * excess, mean_ * (upright_ * power + tilt_ * excess) / root,
            mean_ * upright_ * smoothing_ * smoothing_ / (root * root * root)};
  }
  // The energy with the corner.
  double Unsmoothed(double power) const { return power > 0 ? positive_ * power : -negative_ * power; }
  // Mean of c⁺ and c⁻.
  double mean() const { return mean_; }

 private:
  double positive_, negative_, mean_, tilt_;
  double upright_;    // 1 − t²
  double smoothing_;  // ε
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COSTS_POWER_PRICE_H_
