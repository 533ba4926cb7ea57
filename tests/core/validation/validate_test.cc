// The judge on a motion known in closed form: every figure is at rounding level, and every fault that is put in shows
// in its own figure at its true size.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/validation/report.h"
#include "tests/support/every_scheme.h"
#include "tests/support/flywheel_ball.h"

namespace rollgait {
namespace {

constexpr double kT = FlywheelBall::kDuration;
constexpr double kWeight = FlywheelBall::kMass * 9.81;

class ValidateTest : public ::testing::TestWithParam<Scheme> {
 protected:
  AccuracyReport Report() const { return Validate(scene_, trajectory_, options_); }

  FlywheelBall ball_ = FlywheelBall::Periodic();
  Scene scene_ = FlywheelBall::MakeScene();
  Trajectory trajectory_ = ball_.MakeTrajectory(GetParam());
  ValidationOptions options_;
};

TEST_P(ValidateTest, ExactMotionIsAtRoundingLevel) {
  const AccuracyReport report = Report();
  EXPECT_LT(report.max_position_defect, 1e-11);  // integrator tolerance times the interval's sensitivity
  EXPECT_LT(report.max_velocity_defect, 1e-11);
  EXPECT_LT(report.max_gap, 1e-14);
  EXPECT_LT(report.max_slip, 1e-13);
  EXPECT_NEAR(report.min_normal_force, kWeight, 1e-9);
  // Largest at the ends, where the torque is.
  EXPECT_NEAR(report.max_friction_ratio, std::abs(ball_.Force(0).x()) / kWeight, 1e-10);
  EXPECT_GT(report.max_friction_ratio, 0.05);
  EXPECT_NEAR(report.min_swing_clearance, FlywheelBall::kHubClearance, 1e-14);
  EXPECT_LT(report.periodicity_error, 1e-13);
  EXPECT_LT(report.energy_balance_error, 1e-12);
  EXPECT_LT(report.energy_balance_error_relative, 1e-13);
  EXPECT_LT(report.momentum_balance_error, 1e-12);
  EXPECT_EQ(report.integrator_tolerance, 1e-10);
}

TEST_P(ValidateTest, ExactMotionOnASlope) {
  ball_.gravity = 9.81 * Vector3(-std::sin(0.15), 0, -std::cos(0.15));
  options_.gravity = ball_.gravity;
  trajectory_ = ball_.MakeTrajectory(GetParam());
  AccuracyReport report = Report();
  // The end of the trajectory is compared with the mirrored start as well, and this motion is not periodic: the defect
  // is the change of the velocity of the flywheel. Without that last comparison everything is exact.
  EXPECT_GT(report.periodicity_error, 0.1);
  EXPECT_NEAR(report.max_velocity_defect, report.periodicity_error, 1e-10);
  EXPECT_LT(report.max_slip, 1e-13);
  EXPECT_LT(report.energy_balance_error, 1e-11);
  EXPECT_LT(report.momentum_balance_error, 1e-11);
  EXPECT_NEAR(report.min_normal_force, kWeight * std::cos(0.15), 1e-9);
  // The same motion judged with another slope is wrong.
  options_.gravity = {0, 0, -9.81};
  report = Report();
  EXPECT_GT(report.energy_balance_error, 0.01);
  EXPECT_GT(report.momentum_balance_error, 1);
}

TEST_P(ValidateTest, GapOfOneMillimetre) {
  for (TrajectoryPhase& phase : trajectory_.phases) phase.node_positions.row(1).array() += 1e-3;
  EXPECT_NEAR(Report().max_gap, 1e-3, 1e-12);
  for (TrajectoryPhase& phase : trajectory_.phases) phase.node_positions.row(1).array() -= 3e-3;
  EXPECT_NEAR(Report().max_gap, 2e-3, 1e-12);
}

TEST_P(ValidateTest, Slip) {
  const double slip = 0.02;
  for (TrajectoryPhase& phase : trajectory_.phases) {
    phase.node_velocities.row(0).array() += slip;
    for (int k = 0; k < 5; ++k) phase.node_positions(0, k) += slip * phase.node_times[k];
  }
  const AccuracyReport report = Report();
  EXPECT_NEAR(report.max_slip, slip, 1e-12);
  EXPECT_NEAR(report.periodicity_error, slip * kT, 1e-12);
  // The contact is carried on as it is, not corrected, so that the interval itself is still exact.
  EXPECT_NEAR(report.max_position_defect, slip * kT, 1e-10);
  EXPECT_LT(report.max_gap, 1e-14);
}

TEST_P(ValidateTest, PolynomialThatLeavesTheContactBetweenNodes) {
  // The nodes are exact, and so is the re-integration; only what lies between the nodes is wrong.
  const int s = trajectory_.points_per_interval;
  const double extra = 0.5, h = 0.2 * kT / 2;  // third interval of the first phase
  trajectory_.phases[0].point_accelerations.row(0).segment(2 * s, s).array() += extra;
  EXPECT_NEAR(Report().max_slip, extra * h, 1e-12);
  EXPECT_LT(Report().max_gap, 1e-14);
  trajectory_.phases[0].point_accelerations.row(1).segment(2 * s, s).array() += extra;
  EXPECT_NEAR(Report().max_gap, extra * h * h / 2, 1e-12);
  EXPECT_LT(Report().max_velocity_defect, 1e-11);
}

TEST_P(ValidateTest, WrongTorque) {
  const int s = trajectory_.points_per_interval;
  const double extra = 0.01, h = 0.2 * kT / 2;  // third interval of the second phase
  trajectory_.phases[1].point_efforts.middleCols(2 * s, s).array() += extra;
  const AccuracyReport report = Report();
  const double flywheel = extra * (1 / FlywheelBall::kWheelInertia + 1 / FlywheelBall::Inertia());
  EXPECT_NEAR(report.max_velocity_defect, flywheel * h, 1e-9);
  EXPECT_NEAR(report.max_position_defect, flywheel * h * h / 2, 1e-9);
  EXPECT_EQ(report.max_velocity_defect_joint, 3);
  EXPECT_EQ(report.max_position_defect_joint, 3);
  EXPECT_EQ(report.max_velocity_defect_time, trajectory_.phases[1].node_times[3]);
  EXPECT_EQ(report.max_position_defect_time, trajectory_.phases[1].node_times[3]);
  const double start = trajectory_.phases[1].node_times[2];
  const double turned = ball_.Position(start + h)[3] - ball_.Position(start)[3];
  EXPECT_NEAR(report.energy_balance_error, std::abs(extra * turned), 1e-12);
}

TEST_P(ValidateTest, BrokenNode) {
  trajectory_.phases[0].node_positions(2, 2) += 1e-4;
  const AccuracyReport report = Report();
  EXPECT_NEAR(report.max_position_defect, 1e-4, 1e-9);
  EXPECT_EQ(report.max_position_defect_joint, 2);
}

TEST_P(ValidateTest, JumpBetweenPhases) {
  // The whole second phase lies 0.3 m further on: each interval is exact, the end is periodic, the phases do not meet.
  trajectory_.phases[1].node_positions.row(0).array() += 0.3;
  trajectory_.displacement += 0.3;
  const AccuracyReport report = Report();
  EXPECT_LT(report.periodicity_error, 1e-13);
  EXPECT_NEAR(report.max_position_defect, 0.3, 1e-10);
  EXPECT_EQ(report.max_position_defect_joint, 0);
  EXPECT_EQ(report.max_position_defect_time, trajectory_.phases[0].node_times.back());
}

TEST_P(ValidateTest, BrokenPeriodicity) {
  trajectory_.displacement += 0.013;
  const AccuracyReport report = Report();
  EXPECT_NEAR(report.periodicity_error, 0.013, 1e-12);
  EXPECT_NEAR(report.max_position_defect, 0.013, 1e-10);
  EXPECT_EQ(report.max_position_defect_joint, 0);
  EXPECT_NEAR(report.max_position_defect_time, kT, 1e-15);
}

TEST_P(ValidateTest, WrongForce) {
  for (TrajectoryPhase& phase : trajectory_.phases) phase.point_forces.row(0).array() += 0.5;
  EXPECT_NEAR(Report().momentum_balance_error, 0.5 * kT, 1e-11);
}

TEST_P(ValidateTest, PullingContactAtOnePoint) {
  const int s = trajectory_.points_per_interval;
  trajectory_.phases[0].point_forces(2, s + 1) = -7;
  const AccuracyReport report = Report();
  EXPECT_LE(report.min_normal_force, -7 + 1e-12);
  // Tangential force over the floor of a thousandth of the weight.
  EXPECT_GT(report.max_friction_ratio, 10);
}

TEST_P(ValidateTest, PullingContactInTheMotionOnly) {
  // Downward gravity that is really upward: the returned forces still say that all is well.
  options_.gravity = {0, 0, 2.0};
  EXPECT_NEAR(Report().min_normal_force, -2.0 * FlywheelBall::kMass, 1e-9);
}

TEST_P(ValidateTest, FrictionAtOnePoint) {
  const int s = trajectory_.points_per_interval;
  trajectory_.phases[1].point_forces(0, 2 * s + s - 1) = 1.5 * kWeight;
  EXPECT_NEAR(Report().max_friction_ratio, 1.5, 1e-9);
}

TEST_P(ValidateTest, SwingSurfaceUnderTheGround) {
  scene_.contacts[1].surface = Ellipsoid(Vector3::Constant(FlywheelBall::kRadius + 0.02));
  EXPECT_NEAR(Report().min_swing_clearance, -0.02, 1e-12);
}

TEST_P(ValidateTest, EnergyError) {
  // A last node that is too fast: more energy than the torque has put in.
  const double v = trajectory_.phases[1].node_velocities(0, 4), extra = 0.1;
  trajectory_.phases[1].node_velocities(0, 4) += extra;
  const double energy = 0.5 * FlywheelBall::kMass * (2 * v * extra + extra * extra);
  const AccuracyReport report = Report();
  EXPECT_NEAR(report.energy_balance_error, energy, 1e-10);
  EXPECT_GT(report.energy_balance_error_relative, 1e-3);
  EXPECT_NEAR(report.momentum_balance_error, FlywheelBall::kMass * extra, 1e-10);
}

TEST_P(ValidateTest, NothingHidesBehindNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Trajectory good = trajectory_;
  trajectory_.phases[0].point_efforts(0, 1) = nan;
  EXPECT_EQ(Report().max_position_defect, kInfinity);
  EXPECT_EQ(Report().energy_balance_error, kInfinity);
  trajectory_ = good;
  trajectory_.phases[0].point_accelerations(0, 1) = nan;
  EXPECT_EQ(Report().max_gap, kInfinity);
  EXPECT_EQ(Report().max_slip, kInfinity);
  trajectory_ = good;
  trajectory_.phases[0].point_forces(2, 1) = nan;
  EXPECT_EQ(Report().min_normal_force, -kInfinity);
  EXPECT_EQ(Report().max_friction_ratio, kInfinity);
  EXPECT_EQ(Report().momentum_balance_error, kInfinity);
  trajectory_ = good;
  trajectory_.phases[1].node_velocities(2, 4) = nan;
  EXPECT_EQ(Report().periodicity_error, kInfinity);
  EXPECT_EQ(Report().max_velocity_defect, kInfinity);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ValidateTest, ::testing::ValuesIn(EveryCollocation()));

}  // namespace
}  // namespace rollgait
