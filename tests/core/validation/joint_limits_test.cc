#include "core/validation/joint_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/every_scheme.h"
#include "tests/support/flywheel_ball.h"

namespace rollgait {
namespace {

// The flywheel's limits; the third interval of the first phase is where faults are planted.
class JointLimits : public ::testing::TestWithParam<Scheme> {
 protected:
  static constexpr int kInterval = 2;

  FindingLog Judge() const {
    std::vector<Joint> joints = FlywheelBall::MakeScene().model.joints();
    joints[3] = wheel_;
    FindingLog log(8);
    MeasureJointLimits(Model::Create(joints).value(), trajectory_, &log);
    return log;
  }
  double Length() const {
    const std::vector<double>& times = trajectory_.phases[0].node_times;
    return times[kInterval + 1] - times[kInterval];
  }
  double Middle() const { return trajectory_.phases[0].node_times[kInterval] + 0.5 * Length(); }
  // Adds f(θ) at the points of the interval, of degree <= 1 for Radau-2.
  template <class F>
  void Plant(MatrixX* points, int row, const F& f) const {
    const int s = trajectory_.points_per_interval;
    for (int i = 0; i < s; ++i) (*points)(row, kInterval * s + i) += f(trajectory_.point_fractions[i]);
  }
  // An acceleration a (1 − 2 θ) that leaves the velocity at the end as it was: between the nodes the velocity rises by
  // a h / 4.
  void PlantVelocity(double peak) {
    const double a = 4 * peak / Length();
    Plant(&trajectory_.phases[0].point_accelerations, 3, [a](double theta) { return a * (1 - 2 * theta); });
  }
  void ExpectOnly(const FindingLog& log, Criterion criterion, double value, double time) const {
    EXPECT_NEAR(log[criterion].value, value, 1e-12);
    EXPECT_EQ(log[criterion].where, "flywheel");
    EXPECT_EQ(log[criterion].phase, 0);
    EXPECT_NEAR(log[criterion].time, time, 1e-6);
    for (int k = 0; k < 8; ++k) EXPECT_NEAR(log.intervals()[k][criterion], k == kInterval ? value : 0.0, 1e-12) << k;
  }

  static FlywheelBall Coasting() {
    FlywheelBall ball;  // no torque: the wheel stands still
    ball.speed = 2;
    return ball;
  }

  Joint wheel_ = FlywheelBall::MakeScene().model.joint(3);
  Trajectory trajectory_ = Coasting().MakeTrajectory(GetParam());
};

TEST_P(JointLimits, NothingIsPastItsLimit) {
  wheel_.position_min = wheel_.position_max = 0;
  wheel_.velocity_max = 1e-9;
  const FindingLog log = Judge();
  for (Criterion criterion : {Criterion::kJointRange, Criterion::kJointVelocity, Criterion::kJointEffort}) {
    EXPECT_LT(log[criterion].value, 1e-13);
  }
}

TEST_P(JointLimits, VelocityBetweenNodes) {
  wheel_.velocity_max = 4;
  PlantVelocity(6);
  ExpectOnly(Judge(), Criterion::kJointVelocity, 0.5, Middle());
  wheel_.velocity_max = 6 * (1 + 1e-12);
  EXPECT_EQ(Judge()[Criterion::kJointVelocity].value, 0);
}

TEST_P(JointLimits, VelocityBackwards) {
  wheel_.velocity_max = 5;
  PlantVelocity(-6);
  ExpectOnly(Judge(), Criterion::kJointVelocity, 0.2, Middle());
}

TEST_P(JointLimits, RangeBetweenNodes) {
  // The velocity ±v of a node becomes ∓v at the end: between, the position goes v h / 4 up and comes back.
  const double v = 3;
  trajectory_.phases[0].node_velocities(3, kInterval) = v;
  const double a = -2 * v / Length();
  Plant(&trajectory_.phases[0].point_accelerations, 3, [a](double) { return a; });
  wheel_.position_max = 0.01;
  const double past = v * Length() / 4 - 0.01;
  ASSERT_GT(past, 0.05);
  ExpectOnly(Judge(), Criterion::kJointRange, past, Middle());
  wheel_.position_max = kInfinity;
  EXPECT_EQ(Judge()[Criterion::kJointRange].value, 0);
  // The other end of the range.
  trajectory_.phases[0].node_velocities(3, kInterval) = -v;
  Plant(&trajectory_.phases[0].point_accelerations, 3, [a](double) { return -2 * a; });
  wheel_.position_min = -0.02;
  ExpectOnly(Judge(), Criterion::kJointRange, v * Length() / 4 - 0.02, Middle());
}

TEST_P(JointLimits, RangePassedInAStraightLine) {
  trajectory_.phases[0].node_velocities(3, kInterval) = 2;
  wheel_.position_max = 0.75 * 2 * Length();
  ExpectOnly(Judge(), Criterion::kJointRange, 0.25 * 2 * Length(), trajectory_.phases[0].node_times[kInterval + 1]);
}

TEST_P(JointLimits, EffortBetweenPoints) {
  // Radau-2: linear, and largest where there is no point. Others: a parabola, its top away from every point but the
  // middle one.
  const bool linear = trajectory_.points_per_interval == 2;
  const auto plant = [&](double peak) {
    Plant(&trajectory_.phases[0].point_efforts, 0,
          [&](double theta) { return linear ? peak * (1 - theta) : 4 * peak * theta * (1 - theta); });
  };
  const double time = linear ? trajectory_.phases[0].node_times[kInterval] : Middle();
  wheel_.effort_min = -50;
  plant(130);
  ExpectOnly(Judge(), Criterion::kJointEffort, 0.3, time);
  plant(-130 - 60);
  ExpectOnly(Judge(), Criterion::kJointEffort, 0.2, time);
  // A limit of zero: over the larger of the two.
  wheel_.effort_min = 0;
  ExpectOnly(Judge(), Criterion::kJointEffort, 0.6, time);
  wheel_.effort_min = -kInfinity;
  EXPECT_EQ(Judge()[Criterion::kJointEffort].value, 0);
}

TEST_P(JointLimits, NaNIsPastEveryLimit) {
  trajectory_.phases[0].point_efforts(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Judge()[Criterion::kJointEffort].value, kInfinity);
  trajectory_.phases[0].point_accelerations(3, 1) = std::numeric_limits<double>::quiet_NaN();
  // Without limits there is nothing to judge.
  EXPECT_EQ(Judge()[Criterion::kJointRange].value, 0);
  wheel_.position_max = 1e6;
  wheel_.velocity_max = 1e6;
  EXPECT_EQ(Judge()[Criterion::kJointRange].value, kInfinity);
  EXPECT_EQ(Judge()[Criterion::kJointVelocity].value, kInfinity);
}

INSTANTIATE_TEST_SUITE_P(Schemes, JointLimits, ::testing::ValuesIn(EveryCollocation()));

}  // namespace
}  // namespace rollgait
