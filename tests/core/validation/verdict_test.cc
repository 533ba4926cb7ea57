// The whole judge against planted faults: each shows in its own criterion at its true size, with its place and its
// interval, and turns the verdict.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/validation/report.h"
#include "tests/support/every_scheme.h"
#include "tests/support/flywheel_ball.h"

namespace rollgait {
namespace {

constexpr double kBallWeight = FlywheelBall::kMass * 9.81;

class VerdictTest : public ::testing::TestWithParam<Scheme> {
 protected:
  VerdictTest() { options_.friction_coefficient = 0.8; }

  void Judge() { report_ = Validate(scene_, trajectory_, options_); }
  const Finding& Found(Criterion criterion) const { return report_.findings[static_cast<int>(criterion)]; }
  // Exactly one criterion is exceeded, and by that finding.
  void ExpectOne(Criterion criterion, double value, double tolerance, const std::string& where, int phase,
                 double time) {
    Judge();
    const Finding& finding = Found(criterion);
    EXPECT_NEAR(finding.value, value, tolerance);
    EXPECT_EQ(finding.where, where);
    EXPECT_EQ(finding.phase, phase);
    EXPECT_NEAR(finding.time, time, 1e-3);
    EXPECT_TRUE(Exceeds(criterion));
  }
  bool Exceeds(Criterion criterion) const {
    for (const Excess& excess : JudgeFindings(report_.findings, StandardBounds()).excesses) {
      if (excess.criterion == criterion) return true;
    }
    return false;
  }
  // The largest of an interval, and of all others.
  void ExpectInterval(Criterion criterion, int number, double value, double others) const {
    ASSERT_EQ(report_.intervals.size(), 8u);
    for (int k = 0; k < 8; ++k) {
      if (k == number) {
        EXPECT_NEAR(report_.intervals[k][criterion], value, 1e-6 * value);
      } else {
        EXPECT_LE(report_.intervals[k][criterion], others) << k;
      }
    }
  }
  // Adds f(θ) at the points of the third interval of the second phase.
  template <class F>
  void Plant(MatrixX* points, int row, const F& f) const {
    const int s = trajectory_.points_per_interval;
    for (int i = 0; i < s; ++i) (*points)(row, 2 * s + i) += f(trajectory_.point_fractions[i]);
  }

  FlywheelBall ball_ = FlywheelBall::Periodic();
  Scene scene_ = FlywheelBall::MakeScene();
  Trajectory trajectory_ = ball_.MakeTrajectory(GetParam());
  ValidationOptions options_;
  AccuracyReport report_;
};

TEST_P(VerdictTest, ExactMotionIsWithinEveryBound) {
  Judge();
  EXPECT_EQ(JudgeFindings(report_.findings, FineBounds()).kind, Verdict::Kind::kWithin);
  for (const CriterionTraits& traits : Criteria()) EXPECT_LT(Found(traits.criterion).value, 1e-10) << traits.field;
  ASSERT_EQ(report_.intervals.size(), 8u);
  for (const CriterionValues& values : report_.intervals) {
    for (const CriterionTraits& traits : Criteria()) EXPECT_LT(values[traits.criterion], 1e-10) << traits.field;
  }
}

TEST_P(VerdictTest, Defects) {
  const double extra = 40, h = 0.2 * ball_.kDuration / 2, start = trajectory_.phases[1].node_times[2];
  Plant(&trajectory_.phases[1].point_efforts, 0, [&](double) { return 0.05 * extra; });
  const double flywheel = 0.05 * extra * (1 / FlywheelBall::kWheelInertia + 1 / FlywheelBall::Inertia());
  ExpectOne(Criterion::kVelocityDefect, flywheel * h, 1e-8, "flywheel", 1, start + h);
  ExpectInterval(Criterion::kVelocityDefect, 6, flywheel * h, 1e-10);
  ExpectOne(Criterion::kPositionDefect, flywheel * h * h / 2, 1e-8, "flywheel", 1, start + h);
  ExpectInterval(Criterion::kPositionDefect, 6, flywheel * h * h / 2, 1e-10);
  // That work went nowhere: energy of that interval alone.
  const double turned = ball_.Position(start + h)[3] - ball_.Position(start)[3];
  EXPECT_NEAR(Found(Criterion::kEnergy).time, start, 1e-12);
  EXPECT_NEAR(Found(Criterion::kEnergy).value,
              std::abs(0.05 * extra * turned) * report_.energy_balance_error_relative / report_.energy_balance_error,
              1e-10);
  ExpectInterval(Criterion::kEnergy, 6, Found(Criterion::kEnergy).value, 1e-10);
}

TEST_P(VerdictTest, PhasesThatDoNotMeetAndAnEndThatIsNotTheStart) {
  trajectory_.phases[1].node_positions.row(0).array() += 0.3;
  trajectory_.displacement += 0.3;
  ExpectOne(Criterion::kPositionDefect, 0.3, 1e-10, "base_x", 0, trajectory_.phases[0].node_times.back());
  for (const CriterionValues& own : report_.intervals)
    EXPECT_LT(own[Criterion::kPositionDefect], 1e-10);  // a border is no interval's
  EXPECT_FALSE(Exceeds(Criterion::kPeriodicity));
  trajectory_.displacement += 2e-3;
  ExpectOne(Criterion::kPeriodicity, 2e-3, 1e-12, "base_x", 1, ball_.kDuration);
}

TEST_P(VerdictTest, VelocitiesAreComparedAcrossBorders) {
  // In the whole second phase the wheel turns faster: each interval is exact, the phases do not meet.
  trajectory_.cycle = Cycle::kOnce;
  TrajectoryPhase& phase = trajectory_.phases[1];
  phase.node_velocities.row(3).array() += 0.5;
  for (int k = 0; k < 5; ++k) phase.node_positions(3, k) += 0.5 * (phase.node_times[k] - phase.node_times[0]);
  ExpectOne(Criterion::kVelocityDefect, 0.5, 1e-9, "flywheel", 0, phase.node_times[0]);
  for (const CriterionValues& own : report_.intervals) EXPECT_LT(own[Criterion::kVelocityDefect], 1e-9);
  EXPECT_FALSE(Exceeds(Criterion::kPositionDefect));
  // At an impact velocities may jump.
  phase.impulses = Vector3(-0.9, 0, 1);
  Judge();
  EXPECT_NEAR(Found(Criterion::kFriction).value, 0.9 / 0.8 - 1, 1e-12);
  EXPECT_EQ(Found(Criterion::kFriction).where, "touch-down tread");
  EXPECT_LT(std::abs(Found(Criterion::kVelocityDefect).value - report_.jump_velocity_error), 1e-9);
}

TEST_P(VerdictTest, LimitsOfTheJoints) {
  std::vector<Joint> joints = scene_.model.joints();
  // The torque starts with 3 N m; the wheel turns back and forth between two extremes that lie inside of intervals.
  joints[3].effort_max = 2;
  double highest = 0, fastest = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double t = i * 1e-5 * ball_.kDuration;
    highest = std::max(highest, ball_.Position(t)[3]);
    fastest = std::max(fastest, std::abs(ball_.Velocity(t)[3]));
  }
  joints[3].position_max = highest - 0.1;
  joints[3].velocity_max = 0.8 * fastest;
  scene_.model = Model::Create(joints).value();
  Judge();
  EXPECT_NEAR(Found(Criterion::kJointRange).value, 0.1, 1e-8);
  EXPECT_EQ(Found(Criterion::kJointRange).where, "flywheel");
  EXPECT_NEAR(Found(Criterion::kJointVelocity).value, 0.25, 1e-8);
  EXPECT_NEAR(Found(Criterion::kJointEffort).value, 0.5, 1e-12);
  EXPECT_TRUE(Exceeds(Criterion::kJointRange) && Exceeds(Criterion::kJointVelocity) &&
              Exceeds(Criterion::kJointEffort));
}

TEST_P(VerdictTest, LeastNormalForceOfTheRequest) {
  options_.min_normal_force = 1.05 * kBallWeight;
  Judge();
  EXPECT_NEAR(Found(Criterion::kPull).value, 0.05, 1e-9);
  EXPECT_EQ(Found(Criterion::kPull).where, "tread");
  for (const CriterionValues& values : report_.intervals) EXPECT_NEAR(values[Criterion::kPull], 0.05, 1e-9);
}

TEST_P(VerdictTest, PullOfTheMotionAlone) {
  options_.gravity = {0, 0, 2};
  Judge();
  EXPECT_NEAR(Found(Criterion::kPull).value, 1, 1e-9);
}

// A torque that rises and falls within one interval: the motion is a polynomial, which the integrator carries over the
// interval in one step or two, and at the ends of steps friction is not at its largest.
TEST_P(VerdictTest, FrictionOfTheMotionBetweenAcceptedSteps) {
  ball_ = FlywheelBall();
  ball_.speed = 2;
  trajectory_ = ball_.MakeTrajectory(GetParam());
  const double wanted = 0.9,
               peak = wanted * kBallWeight * FlywheelBall::Inertia() / (FlywheelBall::kMass * FlywheelBall::kRadius);
  // Largest at 0.37, whatever the integrator makes of halves; torques of Radau-2 are straight lines, largest at one
  // end.
  const bool linear = trajectory_.points_per_interval == 2;
  const double at = linear ? 0 : 0.37;
  Plant(&trajectory_.phases[1].point_efforts, 0,
        [&](double theta) { return peak * (linear ? 1 - theta : 1 - 2.5 * (theta - at) * (theta - at)); });
  Judge();
  EXPECT_NEAR(Found(Criterion::kFriction).value, wanted / 0.8 - 1, 1e-6);
  EXPECT_EQ(Found(Criterion::kFriction).where, "tread");
  const double start = trajectory_.phases[1].node_times[2], h = trajectory_.phases[1].node_times[3] - start;
  EXPECT_NEAR(Found(Criterion::kFriction).time, start + at * h, 1e-4);
  ExpectInterval(Criterion::kFriction, 6, Found(Criterion::kFriction).value, 0);
}

TEST_P(VerdictTest, ATouchDownThatRises) {
  trajectory_.phases[1].contacts = {0, 1};
  trajectory_.phases[1].point_forces = MatrixX::Constant(6, 4 * trajectory_.points_per_interval, 10.0);
  Judge();
  EXPECT_LT(Found(Criterion::kApproach).value, 1e-12);
  trajectory_.phases[0].node_velocities(1, 4) = 0.07;
  ExpectOne(Criterion::kApproach, 0.07, 1e-12, "touch-down hub", 1, trajectory_.phases[1].node_times[0]);
}

TEST_P(VerdictTest, EnergyAndMomentum) {
  trajectory_.phases[1].node_velocities(0, 4) += 0.1;
  ExpectOne(Criterion::kMomentum, 0.1, 1e-10, "", 1, trajectory_.phases[1].node_times[3]);
  ExpectInterval(Criterion::kMomentum, 7, 0.1, 1e-10);
  EXPECT_TRUE(Exceeds(Criterion::kEnergy));
  EXPECT_EQ(Found(Criterion::kEnergy).value, report_.energy_balance_error_relative);
  EXPECT_NEAR(Found(Criterion::kEnergy).time, trajectory_.phases[1].node_times[3], 1e-12);
}

// Each number of a trajectory in turn: a NaN is never within.
TEST_P(VerdictTest, NaNIsNeverWithin) {
  const Trajectory good = trajectory_;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (MatrixX TrajectoryPhase::*part :
       {&TrajectoryPhase::node_positions, &TrajectoryPhase::node_velocities, &TrajectoryPhase::point_accelerations,
        &TrajectoryPhase::point_efforts, &TrajectoryPhase::point_forces}) {
    for (int row = 0; row < (good.phases[1].*part).rows(); ++row) {
      trajectory_ = good;
      (trajectory_.phases[1].*part)(row, 2) = nan;
      Judge();
      EXPECT_EQ(JudgeFindings(report_.findings, StandardBounds()).kind, Verdict::Kind::kExceeded) << row;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, VerdictTest, ::testing::ValuesIn(EveryCollocation()));

}  // namespace
}  // namespace rollgait
