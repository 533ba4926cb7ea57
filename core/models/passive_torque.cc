#include "core/models/passive_torque.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr double kPerDegree = 180 / std::numbers::pi;  // 1/deg in 1/rad
constexpr double kMeasuredMass = 75;                   // kg, of the measured
constexpr double kAnkle = 0, kKnee = 15, kHip = 10;    // degrees, where the other joints of a shared muscle are

// sign · exp(a + b x) with x in degrees.
ExponentialSpring::Term Exponential(double sign, double a, double b) { return {sign * std::exp(a), b * kPerDegree}; }

// Stops of stiffness s (1/rad) at low and high (rad) with the torque k (N m) there.
ExponentialSpring Stops(double k_low, double s_low, double low, double k_high, double s_high, double high) {
  return {0, {{{k_low * std::exp(s_low * low), -s_low}, {-k_high * std::exp(-s_high * high), s_high}}}};
}

ExponentialSpring Hip() {
  return {8.072,
          {{Exponential(1, 1.4655 - 0.0034 * kKnee, -0.0750), Exponential(-1, 1.3403 - 0.0226 * kKnee, 0.0305)}}};
}
ExponentialSpring Knee() {
  return {-4.820,
          {{Exponential(1, 1.800 - 0.0460 * kAnkle + 0.0217 * kHip, -0.0352),
            Exponential(-1, -3.971 - 0.0004 * kAnkle - 0.0128 * kHip, 0.0495), Exponential(1, 2.220, -0.150)}}};
}
// The source counts plantarflexion positive.
ExponentialSpring Ankle() {
  return {1.792,
          {{Exponential(-1, 2.1016 - 0.0176 * kKnee, 0.0843), Exponential(1, -7.9763 + 0.0008 * kKnee, -0.1949)}}};
}

// A fiftieth of the joint's strength 10° before the end of its range, or a quarter of a short range before it; a
// quarter of the strength at the end.
ExponentialSpring AssumedStops(const Joint& joint) {
  const double margin = std::min(10 / kPerDegree, (joint.position_max - joint.position_min) / 4);
  const double k = 0.02 * joint.effort_max, s = std::log(0.25 / 0.02) / margin;
  return Stops(k, s, joint.position_min + margin, k, s, joint.position_max - margin);
}

ExponentialSpring Scaled(ExponentialSpring spring, double factor) {
  spring.offset *= factor;
  for (ExponentialSpring::Term& term : spring.terms) term.k *= factor;
  return spring;
}

}  // namespace

ExponentialSpring PassiveTorque(const Joint& joint, double mass) {
  switch (joint.passive) {
    case PassiveKind::kNone:
      return {};
    case PassiveKind::kHumanHip:
      return Scaled(Hip(), mass / kMeasuredMass);
    case PassiveKind::kHumanKnee:
      return Scaled(Knee(), mass / kMeasuredMass);
    case PassiveKind::kHumanAnkle:
      return Scaled(Ankle(), mass / kMeasuredMass);
    case PassiveKind::kStops:
      return AssumedStops(joint);
  }
  ROLLGAIT_CHECK(false);
}

std::vector<std::string> PassiveTorqueSources() {
  return {
      "Passive torques of hip, knee and ankle: the exponentials that Riener and Edrich (1999, J Biomech 32:539) fitted "
      "to "
      "measurements (from memory), with the neighbouring joints fixed at ankle 0, knee 15, hip 10 deg.",
      "Passive stops of the other joints (assumption): 0.02 of the largest torque 10 deg before the end of the range "
      "(or a "
      "quarter of it), rising exponentially to 0.25 at the end.",
  };
}

}  // namespace rollgait
