// Differences of motions that differ by a known function.
#include "core/validation/motion_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/models/catalog.h"

namespace rollgait {
namespace {

Scene Planar() {
  BodyRequest request;
  request.model = "planar";
  return BuildScene(request).value();
}

// One phase of `duration` s on the left foot, with Radau-2 points on `intervals` equal intervals: the joint's angle is
// a + b·t, all torques are `torque` at the fraction of the phase, the foot is pushed by `force`.
struct Motion {
  int joint = 0;
  double a = 0, b = 0, duration = 0.5;
  int intervals = 4;
  std::function<double(double)> torque = [](double) { return 0; };
  Vector3 force = Vector3::Zero();

  Trajectory Make(const Scene& scene) const {
    const int joints = scene.model.size(), efforts = static_cast<int>(scene.model.actuated().size());
    Trajectory trajectory;
    trajectory.point_fractions = {1.0 / 3, 1};
    trajectory.duration = duration;
    TrajectoryPhase phase;
    phase.contacts = {scene.FindContact("left_foot")};
    phase.duration = duration;
    phase.node_positions = phase.node_velocities = MatrixX::Zero(joints, intervals + 1);
    phase.point_positions = phase.point_velocities = phase.point_accelerations = MatrixX::Zero(joints, 2 * intervals);
    phase.point_efforts = MatrixX::Zero(efforts, 2 * intervals);
    phase.point_forces = MatrixX::Zero(3, 2 * intervals);
    for (int k = 0; k <= intervals; ++k) {
      const double fraction = static_cast<double>(k) / intervals;
      phase.node_times.push_back(fraction * duration);
      phase.node_positions(joint, k) = a + b * fraction * duration;
      phase.node_velocities(joint, k) = b;
      for (int i = 0; i < 2 && k < intervals; ++i) {
        const double at = (k + trajectory.point_fractions[i]) / intervals;
        phase.point_times.push_back(at * duration);
        phase.point_efforts.col(2 * k + i).setConstant(torque(at));
        phase.point_forces.col(2 * k + i) = force;
      }
    }
    trajectory.phases.push_back(phase);
    return trajectory;
  }
};

const QuantityDifference& At(const MotionDifference& difference, MotionQuantity quantity) {
  return difference[static_cast<int>(quantity)];
}

TEST(MotionDifference, OfAMotionWithItselfIsZero) {
  const Scene scene = Planar();
  const Trajectory trajectory = Motion{.joint = 4, .a = 0.3, .b = 1, .force = {1, 2, 3}}.Make(scene);
  for (const QuantityDifference& difference : CompareMotions(scene, trajectory, trajectory)) {
    EXPECT_EQ(difference.largest, 0);
    EXPECT_EQ(difference.rms, 0);
    EXPECT_EQ(difference.peak, 0);
    EXPECT_EQ(difference.where, "");
  }
}

TEST(MotionDifference, FindsJointSizeAndTimeOnDifferentMeshes) {
  const Scene scene = Planar();
  const int knee = scene.model.Find("knee_l");
  ASSERT_GE(knee, 0);
  const Trajectory one = Motion{.joint = knee, .a = 0.2}.Make(scene);
  const Trajectory two = Motion{.joint = knee, .a = 0.2, .b = 0.6, .intervals = 3}.Make(scene);
  const MotionDifference difference = CompareMotions(scene, one, two);
  // 0.6 t: largest near the end (the last Gauss point is before it), RMS 0.6 · 0.5 / √3, exact.
  const QuantityDifference& angle = At(difference, MotionQuantity::kAngle);
  EXPECT_EQ(angle.where, "knee_l");
  EXPECT_NEAR(angle.largest, 0.3, 0.01);
  EXPECT_NEAR(angle.time, 0.5, 0.01);
  EXPECT_NEAR(angle.rms, 0.3 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(angle.peak, 0.3, 0.01);
  EXPECT_NEAR(At(difference, MotionQuantity::kAngularVelocity).largest, 0.6, 1e-12);
  EXPECT_NEAR(At(difference, MotionQuantity::kAngularVelocity).rms, 0.6, 1e-12);
  EXPECT_EQ(At(difference, MotionQuantity::kPlace).largest, 0);
}

TEST(MotionDifference, KeepsTranslationsApartFromAngles) {
  const Scene scene = Planar();
  const int base_x = scene.model.Find("base_x");
  ASSERT_GE(base_x, 0);
  const MotionDifference difference = CompareMotions(scene, Motion{.joint = base_x, .a = 0.02}.Make(scene),
                                                     Motion{.joint = base_x, .a = 0.05}.Make(scene));
  EXPECT_NEAR(At(difference, MotionQuantity::kPlace).largest, 0.03, 1e-15);
  EXPECT_EQ(At(difference, MotionQuantity::kPlace).where, "base_x");
  EXPECT_EQ(At(difference, MotionQuantity::kAngle).largest, 0);
}

TEST(MotionDifference, OfForcesIsTheNormOfTheVector) {
  const Scene scene = Planar();
  const MotionDifference difference = CompareMotions(scene, Motion{.force = {3, 0, 100}}.Make(scene),
                                                     Motion{.intervals = 7, .force = {0, 0, 104}}.Make(scene));
  const QuantityDifference& force = At(difference, MotionQuantity::kContactForce);
  EXPECT_EQ(force.where, "left_foot");
  EXPECT_NEAR(force.largest, 5, 1e-12);
  EXPECT_NEAR(force.rms, 5, 1e-12);
  EXPECT_NEAR(force.peak, 104 - std::hypot(3, 100), 1e-12);
}

// A phase that lasts longer is not compared at equal times, where a torque that moves with the phase would differ.
TEST(MotionDifference, ComparesAtEqualFractionsOfAPhase) {
  const Scene scene = Planar();
  const auto ramp = [](double fraction) { return 50 * fraction; };
  const MotionDifference difference =
      CompareMotions(scene, Motion{.duration = 0.5, .torque = ramp}.Make(scene),
                     Motion{.duration = 0.7, .intervals = 5, .torque = ramp}.Make(scene));
  EXPECT_NEAR(At(difference, MotionQuantity::kTorque).largest, 0, 1e-12);
}

TEST(MotionDifference, HasARowForEveryQuantity) {
  for (int q = 0; q < kMotionQuantityCount; ++q) {
    EXPECT_EQ(static_cast<int>(MotionQuantities()[q].quantity), q);
    EXPECT_STRNE(MotionQuantities()[q].name, "");
    EXPECT_STRNE(MotionQuantities()[q].unit, "");
  }
}

}  // namespace
}  // namespace rollgait
