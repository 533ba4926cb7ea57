#include "core/models/passive_torque.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/models/joint_limits.h"

namespace rollgait {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr const char* kSprung[] = {"hip",
                                   "knee",
                                   "ankle",
                                   "hip_adduction",
                                   "hip_rotation",
                                   "ankle_inversion",
                                   "toe",
                                   "trunk_flexion",
                                   "trunk_bending",
                                   "trunk_rotation",
                                   "shoulder",
                                   "shoulder_adduction",
                                   "shoulder_rotation",
                                   "elbow"};

Joint Named(const std::string& name) {
  Joint joint;
  joint.name = name + "_l";
  joint.passive = name == "hip"     ? PassiveKind::kHumanHip
                  : name == "knee"  ? PassiveKind::kHumanKnee
                  : name == "ankle" ? PassiveKind::kHumanAnkle
                                    : PassiveKind::kStops;
  joint.position_min = LimitsOf(name).position_min * kRadiansPerDegree;
  joint.actuated = true;
  joint.effort_max = LimitsOf(name).effort_per_mass * 75;
  joint.position_max = LimitsOf(name).position_max * kRadiansPerDegree;
  return joint;
}

TEST(PassiveTorque, PushesBackAllOverTheRange) {
  for (const char* joint : kSprung) {
    const JointLimits limits = LimitsOf(joint);
    const ExponentialSpring spring = PassiveTorque(Named(joint), 75);
    for (int i = 0; i <= 50; ++i) {
      const double x =
          (limits.position_min + i / 50.0 * (limits.position_max - limits.position_min)) * kRadiansPerDegree;
      const double step = 1e-6;
      EXPECT_LT(spring.At(x).first, 0) << joint << " " << x;
      // Step 1e-6: rounding 1e-16 / 1e-6 times the value, up to 1e3 N m at the ends.
      const double size = 1 + std::abs(spring.At(x).second);
      EXPECT_NEAR(spring.At(x).first, (spring.At(x + step).value - spring.At(x - step).value) / (2 * step),
                  1e-6 * size);
      EXPECT_NEAR(spring.At(x).second, (spring.At(x + step).first - spring.At(x - step).first) / (2 * step),
                  1e-5 * size);
    }
  }
}

// The formulas of Riener and Edrich typed once more, in degrees and their signs, at a posture.
TEST(PassiveTorque, IsTheMeasuredOne) {
  const double hip = 20, knee = 30, ankle = 12;  // flexion, flexion, dorsiflexion
  EXPECT_NEAR(PassiveTorque(Named("hip"), 75).At(hip * kRadiansPerDegree).value,
              std::exp(1.4655 - 0.0034 * 15 - 0.0750 * hip) - std::exp(1.3403 - 0.0226 * 15 + 0.0305 * hip) + 8.072,
              1e-12);
  EXPECT_NEAR(PassiveTorque(Named("knee"), 75).At(knee * kRadiansPerDegree).value,
              std::exp(1.800 - 0.0352 * knee + 0.217) - std::exp(-3.971 + 0.0495 * knee - 0.128) - 4.820 +
                  std::exp(2.220 - 0.150 * knee),
              1e-12);
  EXPECT_NEAR(
      PassiveTorque(Named("ankle"), 75).At(ankle * kRadiansPerDegree).value,
      -(std::exp(2.1016 + 0.0843 * ankle - 0.0176 * 15) - std::exp(-7.9763 - 0.1949 * ankle + 0.0008 * 15) - 1.792),
      1e-12);
}

TEST(PassiveTorque, GrowsWithTheBody) {
  EXPECT_NEAR(PassiveTorque(Named("knee"), 150).At(0.2).value, 2 * PassiveTorque(Named("knee"), 75).At(0.2).value,
              1e-13);
  Joint base;
  base.name = "base_pitch";
  EXPECT_EQ(PassiveTorque(base, 75).At(1).value, 0);
}

TEST(PassiveTorque, AssumedStopsTakeAQuarterOfTheStrengthAtTheEnds) {
  const Joint elbow = Named("elbow");
  const ExponentialSpring spring = PassiveTorque(elbow, 75);
  EXPECT_NEAR(spring.At(elbow.position_min).value, 0.25 * elbow.effort_max, 1e-9);
  EXPECT_NEAR(spring.At(elbow.position_max).value, -0.25 * elbow.effort_max, 1e-9);
  EXPECT_NEAR(spring.At(elbow.position_min + 10 * kRadiansPerDegree).value, 0.02 * elbow.effort_max, 1e-9);
}

}  // namespace
}  // namespace rollgait
