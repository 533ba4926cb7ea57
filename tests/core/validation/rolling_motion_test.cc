// Forward simulation of rolling bodies with the judge's own integrator and dynamics, against closed forms and the
// quadruple-precision reference trajectories.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "core/contact/constrained_dynamics.h"
#include "core/validation/integrator.h"
#include "tests/support/matrix_near.h"
#include "tests/support/rolling_body.h"

namespace rollgait {
namespace {

// A body that rolls, integrated from one time to another.
class Roller {
 public:
  Roller(const RollingBody& body, const Vector3& gravity, double tolerance)
      : dynamics_(body.model), constrained_(dynamics_, {body.surface}), gravity_(gravity) {
    options_.tolerance = tolerance;
  }

  void Advance(double from, double to, VectorX* q, VectorX* v) {
    const int n = dynamics_.size();
    VectorX x(2 * n);
    x << *q, *v;
    const auto right_side = [&](double, const VectorX& state, VectorX* derivative) {
      derivative->head(n) = state.tail(n);
      derivative->tail(n) =
          constrained_.Evaluate(state.head(n), state.tail(n), VectorX::Zero(n), gravity_).acceleration;
    };
    options_.first_step = integrator_.proposed_step();
    ASSERT_EQ(integrator_.Integrate(right_side, from, to, options_, &x), IntegrationStatus::kReachedEnd);
    *q = x.head(n);
    *v = x.tail(n);
    // Leaves contact and state at the end.
    constrained_.Evaluate(*q, *v, VectorX::Zero(n), gravity_);
  }

  double Energy() const {
    return dynamics_.KineticEnergy(constrained_.state()) + dynamics_.PotentialEnergy(constrained_.state(), gravity_);
  }
  Matrix3 Orientation() const { return constrained_.state().back().R_WL; }
  Vector3 Omega() const { return Orientation() * constrained_.state().back().twist.angular; }
  const RollingContact& contact() const { return constrained_.contact(0); }
  Vector3 CenterOfMass() const { return dynamics_.CenterOfMass(constrained_.state()); }

 private:
  BodyDynamics dynamics_;
  ConstrainedDynamics constrained_;
  Dop853 integrator_;
  Dop853::Options options_;
  Vector3 gravity_;
};

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

TEST(RollingMotion, RattlebackReversesWhenItMust) {
  const Vector3 axes(0.2, 0.03, 0.02);
  Matrix3 inertia;
  inertia << 2e-4, -2e-5, 0, -2e-5, 1.6e-3, 0, 0, 0, 1.7e-3;
  const RollingBody stone = MakeRollingBody(axes, 1.0, Vector3(0, 0, 0.01), inertia);
  Roller roller(stone, Vector3(0, 0, -9.81), 1e-11);
  const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/rattleback_KL82_undamped.csv");
  VectorX q, v;
  SetRolling(axes, rows[0].R, rows[0].R * rows[0].omega, 0, 0, &q, &v);
  roller.Advance(0, rows[1].t, &q, &v);
  EXPECT_TRUE(MatrixNear(roller.CenterOfMass(), rows[1].com, 1e-11));

  // The first zero of the spin about the vertical, by a secant iteration after the step that brackets it.
  // Three zeros follow each other within 0.05 s, so the last stretch goes in short steps.
  roller.Advance(rows[1].t, 2.7, &q, &v);
  double t = 2.7, spin = roller.Omega().z();
  const double sign = spin > 0 ? 1 : -1;
  VectorX q_before = q, v_before = v;
  double t_before = t, spin_before = spin;
  while (spin * sign > 0 && t < 4) {
    q_before = q, v_before = v, t_before = t, spin_before = spin;
    t = t_before + 0.01;
    roller.Advance(t_before, t, &q, &v);
    spin = roller.Omega().z();
  }
  double low = t_before, low_spin = spin_before, high = t, high_spin = spin;
  for (int i = 0; i < 12 && std::abs(high_spin) > 1e-13; ++i) {
    const double next = high - high_spin * (high - low) / (high_spin - low_spin);
    low = high, low_spin = high_spin;
    high = next;
    q = q_before, v = v_before;
    roller.Advance(t_before, high, &q, &v);
    high_spin = roller.Omega().z();
  }
  EXPECT_NEAR(high, 2.761109153800631, 1e-8);
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
