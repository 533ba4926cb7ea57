#include "core/validation/residuals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

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
