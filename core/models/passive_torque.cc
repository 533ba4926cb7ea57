#include "core/models/passive_torque.h"

#include <cmath>
#include <numbers>

namespace rollgait {
namespace {

constexpr double kPerDegree = 180 / std::numbers::pi;  // 1/deg in 1/rad
constexpr double kMass = 75;                           // kg, of the measured
constexpr double kAnkle = 0, kKnee = 15, kHip = 10;    // degrees, where the other joints of a shared muscle are

// sign · exp(a + b x) with x in degrees.
ExponentialSpring::Term Exponential(double sign, double a, double b) { return {sign * std::exp(a), b * kPerDegree}; }

// Stops of stiffness s (1/rad) at low and high (rad) with the torque k (N m) there.
ExponentialSpring Stops(double k_low, double s_low, double low, double k_high, double s_high, double high) {
  return {0, {{{k_low * std::exp(s_low * low), -s_low}, {-k_high * std::exp(-s_high * high), s_high}}}};
}

ExponentialSpring Hip() {
  return {8.072, {{Exponential(1, 1.4655 - 0.0034 * kKnee, -0.0750), Exponential(-1, 1.3403 - 0.0226 * kKnee, 0.0305)}}};
}
ExponentialSpring Knee() {
  return {-4.820,
          {{Exponential(1, 1.800 - 0.0460 * kAnkle + 0.0217 * kHip, -0.0352),
            Exponential(-1, -3.971 - 0.0004 * kAnkle - 0.0128 * kHip, 0.0495), Exponential(1, 2.220, -0.150)}}};
}
// The source counts plantarflexion positive.
ExponentialSpring Ankle() {
  return {1.792, {{Exponential(-1, 2.1016 - 0.0176 * kKnee, 0.0843), Exponential(1, -7.9763 + 0.0008 * kKnee, -0.1949)}}};
}

ExponentialSpring Reference(const std::string& joint) {
  if (joint == "hip") return Hip();
  if (joint == "knee") return Knee();
  if (joint == "ankle") return Ankle();
  if (joint == "hip_adduction") return Stops(0.03, 14.94, -0.5, 0.03, 14.94, 0.5);
  if (joint == "hip_rotation") return Stops(0.03, 14.94, -0.92, 0.03, 14.94, 0.92);
  if (joint == "ankle_inversion") return Stops(60.21, 16.32, -0.65, 60.21, 16.32, 0.65);
  if (joint == "toe") return Stops(0.18, 70.08, 0, 0.9, 14.87, 1.134);
  if (joint == "trunk_flexion") return Stops(0.35, 30.72, -0.17, 0.25, 20.36, 0.5236);
  if (joint == "trunk_bending" || joint == "trunk_rotation") return Stops(0.25, 20.36, -0.35, 0.25, 20.36, 0.35);
  return {};
}

}  // namespace

ExponentialSpring PassiveTorque(const std::string& joint, double mass) {
  const bool sided = joint.ends_with("_l") || joint.ends_with("_r");
  ExponentialSpring spring = Reference(sided ? joint.substr(0, joint.size() - 2) : joint);
  spring.offset *= mass / kMass;
  for (ExponentialSpring::Term& term : spring.terms) term.k *= mass / kMass;
  return spring;
}

std::vector<std::string> PassiveTorqueSources() {
  return {
      "Passive torques of hip, knee and ankle: the exponentials that Riener and Edrich (1999, J Biomech 32:539) fitted to "
      "measurements (from memory), with the neighbouring joints fixed at ankle 0, knee 15, hip 10 deg.",
      "Passive stops of hip adduction and rotation, foot, toes and trunk: exponentials after Anderson (1999) as they are "
      "used with OpenSim models (from memory).",
  };
}

}  // namespace rollgait
