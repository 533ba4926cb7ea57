// Forward simulation of rolling bodies with the judge's own integrator and dynamics, against closed forms and the
// quadruple-precision reference trajectories.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/contact/constrained_dynamics.h"
#include "core/math/integrator.h"
#include "tests/support/matrix_near.h"
#include "tests/support/roller.h"
#include "tests/support/rolling_body.h"

namespace rollgait {
namespace {

TEST(RollingMotion, BallOnAnInclineInClosedForm) {
  const double radius = 0.25, slope = 10 * M_PI / 180;
  const Vector3 gravity = 9.81 * Vector3(-std::sin(slope), 0, -std::cos(slope));
  const Vector3 axes = Vector3::Constant(radius);
  const RollingBody ball =
      MakeRollingBody(axes, 1.5, Vector3::Zero(), 0.4 * 1.5 * radius * radius * Matrix3::Identity());
  VectorX q, v;
  SetRolling(axes, Matrix3::Identity(), Vector3(0.4, 3, 0.5), 0, 0, &q, &v);
  const VectorX q0 = q, v0 = v;
  Roller roller(ball, gravity, 1e-12);
  roller.Advance(0, 0.5, &q, &v);
  const Vector3 acceleration(5.0 / 7 * gravity.x(), 0, 0);
  EXPECT_TRUE(MatrixNear(q.head(3), q0.head(3) + 0.5 * v0.head(3) + 0.125 * acceleration, 1e-11));
  EXPECT_TRUE(MatrixNear(v.head(3), v0.head(3) + 0.5 * acceleration, 1e-11));
}

TEST(RollingMotion, TriaxialEllipsoidOnATiltedPlaneFollowsTheReference) {
  const Vector3 axes(0.319, 0.242, 0.098);
  const RollingBody body = MakeRollingBody(axes, 0.365, Vector3::Zero(),
                                           Vector3(0.004976264, 0.008129645, 0.011703724999999998).asDiagonal());
  Roller roller(body, Vector3(1.7034886229125867, 0, -9.66096405704976), 1e-12);
  const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/triaxial_tri_08_side_tilt10.csv");
  ASSERT_EQ(rows.size(), 21u);
  VectorX q, v;
  SetRolling(axes, rows[0].R, rows[0].R * rows[0].omega, 0, 0, &q, &v);
  for (size_t i = 1; i < 11; ++i) {
    roller.Advance(rows[i - 1].t, rows[i].t, &q, &v);
    // The reference grows a perturbation some 60 times in these 3 s; local errors are 1e-12 a step.
    const double allowed = 3e-9;
    EXPECT_TRUE(MatrixNear(roller.Orientation(), rows[i].R, allowed)) << rows[i].t;
    EXPECT_TRUE(MatrixNear(roller.CenterOfMass(), rows[i].com, allowed)) << rows[i].t;
    EXPECT_TRUE(MatrixNear(v.head(3), rows[i].v_com, allowed)) << rows[i].t;
    EXPECT_NEAR(roller.contact().p_WP.x(), rows[i].x, allowed);
    EXPECT_NEAR(roller.Energy(), rows[0].energy, 3e-11);
    // Held at acceleration level: what the integrator leaves, and no more.
    EXPECT_LT(std::abs(roller.contact().gap), 3e-11);
    EXPECT_LT(roller.contact().slip.norm(), 3e-11);
  }
}

// From a late row of the reference; the whole way is in rattleback_slow_test.
TEST(RollingMotion, RattlebackReversesWhenItMust) {
  const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/rattleback_KL82_undamped.csv");
  ASSERT_EQ(rows.size(), 3u);
  Roller roller(Rattleback(), Vector3(0, 0, -9.81), 1e-12);
  VectorX q, v;
  SetRolling(kRattlebackAxes, rows[2].R, rows[2].R * rows[2].omega, rows[2].x, rows[2].y, &q, &v);
  EXPECT_NEAR(NextReversal(rows[2].t, 2.75, &roller, &q, &v), 2.761109153800631, 1e-10);
}

// An unactuated chain without contact keeps its energy.
TEST(RollingMotion, ChainOfThreeKeepsItsEnergy) {
  std::vector<Joint> joints(3);
  for (int i = 0; i < 3; ++i) {
    joints[i].name = "hinge" + std::to_string(i);
    joints[i].link = "rod" + std::to_string(i);
    joints[i].parent = i - 1;
    joints[i].axis = Vector3(0, 1, 0.3 * i).normalized();
    joints[i].p_PJ = Vector3(0, 0, i == 0 ? 0 : -0.5);
    joints[i].mass = 1 + i;
    joints[i].center_of_mass = Vector3(0.02, 0.01, -0.25);
    joints[i].inertia = Vector3(0.02, 0.021, 0.004).asDiagonal();
  }
  const Model model = Model::Create(joints).value();
  const BodyDynamics dynamics(model);
  ConstrainedDynamics free(dynamics, {});
  const Vector3 gravity(0, 0, -9.81);
  VectorX x(6);
  x << 1.2, -0.4, 0.9, 2, -3, 1;
  const auto energy = [&] {
    BodyDynamics::State state;
    dynamics.ComputeState(x.head(3), x.tail(3), &state);
    return dynamics.KineticEnergy(state) + dynamics.PotentialEnergy(state, gravity);
  };
  const double start = energy();
  const VectorX x0 = x;
  Dop853 integrator;
  Dop853::Options options;
  options.tolerance = 1e-12;
  const auto right_side = [&](double, const VectorX& state, VectorX* derivative) {
    derivative->head(3) = state.tail(3);
    derivative->tail(3) = free.Evaluate(state.head(3), state.tail(3), VectorX::Zero(3), gravity).acceleration;
  };
  ASSERT_EQ(integrator.Integrate(right_side, 0, 2, options, &x), IntegrationStatus::kReachedEnd);
  EXPECT_GT((x - x0).norm(), 1);
  // Some hundred steps with local errors of 1e-12 and forces of some ten N.
  EXPECT_NEAR(energy(), start, 1e-9);
}

}  // namespace
}  // namespace rollgait
