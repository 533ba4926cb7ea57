#include "core/validation/residuals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/models/catalog.h"
#include "core/models/planar_human.h"
#include "tests/support/flywheel_ball.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// A trajectory of which only the first and last nodes matter.
Trajectory NodesOnly(const VectorX& q0, const VectorX& v0, const VectorX& q1, const VectorX& v1) {
  Trajectory trajectory;
  TrajectoryPhase phase;
  phase.node_times = {0, 1};
  phase.node_positions.resize(q0.size(), 2);
  phase.node_positions << q0, q1;
  phase.node_velocities.resize(q0.size(), 2);
  phase.node_velocities << v0, v1;
  trajectory.phases.push_back(phase);
  return trajectory;
}

// The error, which the log has, too.
double Periodicity(const Model& model, const Trajectory& trajectory) {
  FindingLog log(1);
  const double error = PeriodicityError(model, trajectory, &log);
  EXPECT_EQ(log[Criterion::kPeriodicity].value, error);
  return error;
}

TEST(PeriodicEnd, HalfCycleOfTheWalkerSwapsTheLegs) {
  const Model model = PlanarHuman(Sex::kFemale, 1.61, 62).model;
  SeededRandom random(3);
  const VectorX q = random.VectorOf(9, -1, 1), v = random.VectorOf(9, -1, 1);
  Trajectory trajectory = NodesOnly(q, v, q, v);
  trajectory.displacement = 0.6;
  VectorX q_end = q, v_end = v;
  for (const char* joint : {"hip", "knee", "ankle"}) {
    const int left = model.Find(std::string(joint) + "_l"), right = model.Find(std::string(joint) + "_r");
    ASSERT_GE(left, 0);
    std::swap(q_end[left], q_end[right]);
    std::swap(v_end[left], v_end[right]);
  }
  q_end[model.Find("base_x")] += 0.6;
  EXPECT_TRUE(MatrixNear(PeriodicEnd(model, trajectory).position, q_end, 0));
  EXPECT_TRUE(MatrixNear(PeriodicEnd(model, trajectory).velocity, v_end, 0));

  trajectory = NodesOnly(q, v, q_end, v_end);
  trajectory.displacement = 0.6;
  EXPECT_EQ(Periodicity(model, trajectory), 0);
  trajectory.phases[0].node_velocities(4, 1) += 0.25;
  EXPECT_NEAR(Periodicity(model, trajectory), 0.25, 1e-15);
  // The full cycle swaps nothing.
  trajectory = NodesOnly(q, v, q, v);
  trajectory.cycle = Cycle::kFull;
  EXPECT_EQ(Periodicity(model, trajectory), 0);
  trajectory.displacement = -0.5;
  EXPECT_EQ(Periodicity(model, trajectory), 0.5);
}

TEST(PeriodicEnd, MirrorSignAndNoBase) {
  Joint joint;
  joint.name = "yaw";
  joint.link = "body";
  joint.mass = 1;
  joint.inertia = Matrix3::Identity();
  joint.mirror_sign = -1;
  const Model model = Model::Create({joint}).value();
  Trajectory trajectory = NodesOnly(VectorX::Constant(1, 0.3), VectorX::Constant(1, 2), VectorX::Constant(1, -0.3),
                                    VectorX::Constant(1, -2));
  trajectory.displacement = 5;  // no joint base_x takes it
  EXPECT_EQ(Periodicity(model, trajectory), 0);
}

TEST(MeasureBalances, WithoutWorkTheKineticEnergyIsTheScale) {
  const Scene scene = FlywheelBall::MakeScene();
  FlywheelBall ball;  // rolls on at constant speed, no torque
  ball.speed = 2;
  Trajectory trajectory = ball.MakeTrajectory(Scheme::kRadau2);
  const BodyDynamics dynamics(scene.model);
  FindingLog log(8);
  EXPECT_LT(MeasureBalances(dynamics, scene.model, trajectory, ball.gravity, &log).energy_relative, 1e-14);
  // Lifted by 1 mm at the end: m g h of energy from nowhere.
  trajectory.phases[1].node_positions(1, 4) += 1e-3;
  const BalanceErrors errors = MeasureBalances(dynamics, scene.model, trajectory, ball.gravity, &log);
  const double kinetic =
      0.5 * (FlywheelBall::kMass * 4 + (FlywheelBall::kBallInertia + FlywheelBall::kWheelInertia) * 25);
  EXPECT_NEAR(errors.energy, FlywheelBall::kMass * 9.81e-3, 1e-12);
  EXPECT_NEAR(errors.energy_relative, errors.energy / kinetic, 1e-12);
}

// What an impact is said to take and to push is part of both balances.
TEST(MeasureBalances, AnImpactThatDidNotHappenIsMissed) {
  const Scene scene = FlywheelBall::MakeScene();
  FlywheelBall ball;
  ball.speed = 2;
  Trajectory trajectory = ball.MakeTrajectory(Scheme::kRadau2);
  trajectory.phases[1].impulses = Vector3(0, 0, 4);
  trajectory.phases[1].impact_loss = 7;
  FindingLog log(8);
  const BalanceErrors errors = MeasureBalances(BodyDynamics(scene.model), scene.model, trajectory, ball.gravity, &log);
  EXPECT_NEAR(errors.energy, 7, 1e-12);
  EXPECT_NEAR(errors.momentum, 4, 1e-12);
  EXPECT_NEAR(log[Criterion::kMomentum].value, 4 / FlywheelBall::kMass, 1e-12);
}

// A damper in the flywheel's joint takes c ω² all the time.
TEST(MeasureBalances, DampersTakeWork) {
  Scene scene = FlywheelBall::MakeScene();
  std::vector<Joint> joints = scene.model.joints();
  joints[3].damping = 0.5;
  scene.model = Model::Create(joints).value();
  FlywheelBall ball;
  ball.speed = 2;
  Trajectory trajectory = ball.MakeTrajectory(Scheme::kRadau2);
  for (TrajectoryPhase& phase : trajectory.phases) phase.node_velocities.row(3).setConstant(3);
  FindingLog log(8);
  const BalanceErrors errors = MeasureBalances(BodyDynamics(scene.model), scene.model, trajectory, ball.gravity, &log);
  EXPECT_NEAR(errors.energy, 0.5 * 9 * FlywheelBall::kDuration, 1e-9);
}

// A ball that is not where, or not turned or turning as, it was asked to be at either end.
TEST(EndError, EveryPartOfBothEnds) {
  BodyRequest request;
  request.model = "ball";
  const Scene scene = BuildScene(request).value();
  const BodyDynamics dynamics(scene.model);
  const VectorX zero = VectorX::Zero(scene.model.size());
  const Trajectory trajectory = NodesOnly(zero, zero, zero, zero);
  BodyDynamics::State state;
  dynamics.ComputeState(zero, zero, &state);
  const BodyDynamics::Link& body = state[scene.contacts.front().joint];
  BodyState there;
  there.x = body.p_WL.x();
  there.y = body.p_WL.y();
  there.orientation = Eigen::Quaterniond(body.R_WL * scene.contacts.front().R_LE);
  EXPECT_NEAR(EndError(scene, dynamics, trajectory, {there, there}), 0, 1e-12);
  const auto expect = [&](const auto& change, double error) {
    BodyState elsewhere = there;
    change(&elsewhere);
    EXPECT_NEAR(EndError(scene, dynamics, trajectory, {there, elsewhere}), error, 1e-9);
    EXPECT_NEAR(EndError(scene, dynamics, trajectory, {elsewhere, there}), error, 1e-9);
  };
  expect([](BodyState* end) { *end->x += 0.03; }, 0.03);
  expect([](BodyState* end) { *end->y -= 0.02; }, 0.02);
  expect([](BodyState* end) { end->angular_velocity.z() = 0.4; }, 0.4);
  expect([](BodyState* end) { *end->orientation = *end->orientation * Eigen::AngleAxisd(0.1, Vector3(0.6, 0, 0.8)); },
         0.1);
}

// A body at rest does no work and has no kinetic energy: what rounding adds to its potential energy is no error, and
// anything more is one without limit.
TEST(MeasureBalances, RoundingOfABodyAtRestIsNoError) {
  const Scene scene = FlywheelBall::MakeScene();
  FlywheelBall ball;
  ball.speed = 0;
  Trajectory trajectory = ball.MakeTrajectory(Scheme::kRadau2);
  const BodyDynamics dynamics(scene.model);
  FindingLog log(8);
  const double height = trajectory.phases[1].node_positions(1, 4);
  trajectory.phases[1].node_positions(1, 4) = height + 1e-15;
  const BalanceErrors rounding = MeasureBalances(dynamics, scene.model, trajectory, ball.gravity, &log);
  EXPECT_GT(rounding.energy, 0);
  EXPECT_EQ(rounding.energy_relative, 0);
  trajectory.phases[1].node_positions(1, 4) = height + 1e-12;
  EXPECT_EQ(MeasureBalances(dynamics, scene.model, trajectory, ball.gravity, &log).energy_relative, kInfinity);
}

}  // namespace
}  // namespace rollgait
