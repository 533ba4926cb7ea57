#include "core/validation/contact_residuals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/every_scheme.h"
#include "tests/support/flywheel_ball.h"

namespace rollgait {
namespace {

// A ball that coasts at 2 m/s; the third interval of the second phase is where faults are planted.
class PlantedContacts : public ::testing::TestWithParam<Scheme> {
 protected:
  static constexpr int kPhase = 1, kInterval = 2, kNumber = 6;
  static constexpr double kWeight = FlywheelBall::kMass * 9.81;

  static FlywheelBall Coasting() {
    FlywheelBall ball;
    ball.speed = 2;
    return ball;
  }
  void Judge() {
    log_ = FindingLog(8);
    forces_ = ForceExtremes(kWeight);
    residuals_ = MeasureContacts(scene_, BodyDynamics(scene_.model), trajectory_, bounds_, &forces_, &log_);
  }
  TrajectoryPhase& phase() { return trajectory_.phases[kPhase]; }
  double Start() { return phase().node_times[kInterval]; }
  double Length() { return phase().node_times[kInterval + 1] - Start(); }
  // Adds f(θ) at the points of the interval.
  template <class F>
  void Plant(MatrixX* points, int row, const F& f) const {
    const int s = trajectory_.points_per_interval;
    for (int i = 0; i < s; ++i) (*points)(row, kInterval * s + i) += f(trajectory_.point_fractions[i]);
  }
  // The joint leaves its place and returns within the interval: as far as `peak`, in the middle.
  void PlantBump(int joint, double peak) {
    const double v = 4 * peak / Length(), a = -2 * v / Length();
    phase().node_velocities(joint, kInterval) += v;
    Plant(&phase().point_accelerations, joint, [a](double) { return a; });
  }
  void Expect(Criterion criterion, double value, double theta, const char* where) {
    EXPECT_NEAR(log_[criterion].value, value, 1e-3 * value);
    EXPECT_EQ(log_[criterion].where, where);
    EXPECT_EQ(log_[criterion].phase, kPhase);
    EXPECT_NEAR(log_[criterion].time, Start() + theta * Length(), 1e-3 * Length());
    for (int k = 0; k < 8; ++k) {
      EXPECT_NEAR(log_.intervals()[k][criterion], k == kNumber ? log_[criterion].value : 0.0, 1e-12) << k;
    }
  }

  Scene scene_ = FlywheelBall::MakeScene();
  Trajectory trajectory_ = Coasting().MakeTrajectory(GetParam());
  ForceBounds bounds_;
  ForceExtremes forces_{1};
  FindingLog log_{8};
  ContactResiduals residuals_;
};

TEST_P(PlantedContacts, NothingIsWrong) {
  bounds_ = {0.01, 1};
  Judge();
  for (Criterion criterion : {Criterion::kGap, Criterion::kSlip}) EXPECT_LT(log_[criterion].value, 1e-13);
  for (Criterion criterion : {Criterion::kPenetration, Criterion::kPull, Criterion::kFriction}) {
    EXPECT_EQ(log_[criterion].value, 0);
  }
}

TEST_P(PlantedContacts, GapBetweenNodes) {
  PlantBump(1, 2e-4);
  Judge();
  Expect(Criterion::kGap, 2e-4, 0.5, "tread");
  EXPECT_NEAR(residuals_.max_gap, 2e-4, 1e-12);
  // Rising is a slip, too, as fast at the end as at the start: rounding says which is the faster.
  const double theta = std::round((log_[Criterion::kSlip].time - Start()) / Length());
  Expect(Criterion::kSlip, 4 * 2e-4 / Length(), theta, "tread");
  trajectory_ = Coasting().MakeTrajectory(GetParam());
  PlantBump(1, -3e-4);
  Judge();
  Expect(Criterion::kGap, 3e-4, 0.5, "tread");
}

TEST_P(PlantedContacts, SlipBetweenNodes) {
  const double peak = 5e-3, a = 4 * peak / Length();
  Plant(&phase().point_accelerations, 0, [a](double theta) { return a * (1 - 2 * theta); });
  Judge();
  Expect(Criterion::kSlip, peak, 0.5, "tread");
  // Across the plane of a mechanism nothing is forbidden, and nothing slips that only rises.
  EXPECT_LT(log_[Criterion::kGap].value, 1e-13);
}

TEST_P(PlantedContacts, PenetrationBetweenNodes) {
  PlantBump(1, -(FlywheelBall::kHubClearance + 1e-3));
  Judge();
  Expect(Criterion::kPenetration, 1e-3, 0.5, "hub");
  EXPECT_NEAR(residuals_.min_swing_clearance, -1e-3, 1e-9);
}

// A knob on the rim of the flywheel that goes under the ground for a hundredth of the interval and less, many times or
// once.
TEST_P(PlantedContacts, NarrowPeaksBetweenSamples) {
  const double arm = 0.35, knob = 0.06, deep = arm + knob - FlywheelBall::kRadius;
  ContactSurface& surface = scene_.contacts[1];
  surface.joint = 3;
  surface.surface = Sphere(knob);
  surface.p_LE = Vector3(0, 0, -arm);
  for (double turns : {0.3, 0.9, 2.7, 7.3, 19.1}) {
    trajectory_ = Coasting().MakeTrajectory(GetParam());
    for (TrajectoryPhase& p : trajectory_.phases) {
      p.node_velocities.row(2).setZero();  // only the flywheel turns
      p.node_positions.row(2).setZero();
      p.node_positions.row(3).setConstant(M_PI);  // the knob is up
    }
    // It is lowest at 37 % of the interval for the first time, if it turns that far.
    const double rate = 2 * M_PI * turns;
    phase().node_positions(3, kInterval) = -0.37 * rate;
    phase().node_velocities(3, kInterval) = rate / Length();
    Judge();
    EXPECT_NEAR(log_[Criterion::kPenetration].value, deep, 1e-3 * deep) << turns;
    EXPECT_EQ(log_[Criterion::kPenetration].where, "hub");
    const double angle = rate * ((log_[Criterion::kPenetration].time - Start()) / Length() - 0.37);
    EXPECT_NEAR(std::remainder(angle, 2 * M_PI), 0, 0.01) << turns;
  }
}

TEST_P(PlantedContacts, PullOfTheReturnedForcesBetweenPoints) {
  // Radau-2: a straight line, lowest where there is no point. Others: a parabola.
  const bool linear = trajectory_.points_per_interval == 2;
  const double low = -0.02 * kWeight;
  Plant(&phase().point_forces, 2,
        [&](double theta) { return (low - kWeight) * (linear ? 1 - theta : 4 * theta * (1 - theta)); });
  bounds_.min_normal = 0.01 * kWeight;
  Judge();
  Expect(Criterion::kPull, 0.03, linear ? 0 : 0.5, "tread");
  EXPECT_NEAR(forces_.min_normal(), low, 1e-9);
}

TEST_P(PlantedContacts, FrictionOfTheReturnedForcesBetweenPoints) {
  const bool linear = trajectory_.points_per_interval == 2;
  Plant(&phase().point_forces, 0,
        [&](double theta) { return -0.9 * kWeight * (linear ? 1 - theta : 4 * theta * (1 - theta)); });
  bounds_.friction = 0.6;
  Judge();
  Expect(Criterion::kFriction, 0.5, linear ? 0 : 0.5, "tread");
  EXPECT_NEAR(forces_.max_friction_ratio(), 0.9, 1e-6);
  bounds_.friction = 0.85;
  Judge();
  Expect(Criterion::kFriction, 0.9 / 0.85 - 1, linear ? 0 : 0.5, "tread");
  bounds_.friction = 0.9001;
  Judge();
  EXPECT_EQ(log_[Criterion::kFriction].value, 0);
}

TEST_P(PlantedContacts, EveryContactThatIsActive) {
  // The hub is active, too, and 50 mm off the ground.
  phase().contacts = {0, 1};
  phase().point_forces = MatrixX::Constant(6, 4 * trajectory_.points_per_interval, 100.0);
  Judge();
  EXPECT_NEAR(residuals_.max_gap, FlywheelBall::kHubClearance, 1e-14);
  EXPECT_EQ(log_[Criterion::kGap].where, "hub");
  EXPECT_NEAR(residuals_.min_swing_clearance, FlywheelBall::kHubClearance, 1e-14);
  EXPECT_NEAR(forces_.max_friction_ratio(), std::sqrt(2.0), 1e-12);
  // With every contact always active there is no swing.
  trajectory_.phases[0].contacts = {0, 1};
  trajectory_.phases[0].point_forces = phase().point_forces;
  Judge();
  EXPECT_EQ(residuals_.min_swing_clearance, 0);
}

TEST_P(PlantedContacts, NaNIsInfinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  phase().point_forces(2, 1) = nan;
  Judge();
  EXPECT_EQ(log_[Criterion::kPull].value, kInfinity);
  EXPECT_EQ(log_[Criterion::kFriction].value, kInfinity);
  phase().point_accelerations(1, 1) = nan;
  Judge();
  EXPECT_EQ(log_[Criterion::kGap].value, kInfinity);
  EXPECT_EQ(log_[Criterion::kSlip].value, kInfinity);
  EXPECT_EQ(log_[Criterion::kPenetration].value, kInfinity);
}

INSTANTIATE_TEST_SUITE_P(Schemes, PlantedContacts, ::testing::ValuesIn(EveryCollocation()));

}  // namespace
}  // namespace rollgait
