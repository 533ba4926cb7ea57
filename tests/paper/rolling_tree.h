#ifndef ROLLGAIT_TESTS_PAPER_ROLLING_TREE_H_
#define ROLLGAIT_TESTS_PAPER_ROLLING_TREE_H_

#include <random>

#include "core/contact/rolling_kinematics.h"
#include "core/multibody/body_dynamics.h"
#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/random_tree.h"

namespace rollgait {

// A tree of seven joints of both types on the motion q(t) = q + v t + a t²/2, whose last link carries an ellipsoid
// (frame origin C away from the ellipsoid's centre) over the plane z = 0. Nothing is in contact or rolls: the equations
// of section 3 hold all the same. World axes, SI units.
struct RollingTree {
  static constexpr int kSize = 7;

  RollingTree() {
    surface.name = "foot";
    surface.joint = kSize - 1;
    surface.surface = Ellipsoid({0.7, 0.23, 1.9});
    surface.p_LE = Vector3(0.2, -0.3, 0.1);
    surface.R_LE = Rotation({0.3, 0.8, -0.4});
  }

  BodyDynamics::State StateAt(double t) const {
    BodyDynamics::State state;
    dynamics.ComputeState(q + v * t + a * (t * t / 2), v + a * t, &state);
    return state;
  }
  RollingContact ContactAt(double t) const { return ComputeRollingContact(surface, StateAt(t)); }
  // 3 × n, of the material point at P.
  MatrixX Jacobian() const {
    MatrixX jacobian(3, kSize);
    const BodyDynamics::State state = StateAt(0);
    RollingJacobian(dynamics, surface, state, ComputeRollingContact(surface, state).p_WP, 0, &jacobian);
    return jacobian;
  }
  // ω, v(C) and C of the last link.
  Vector3 Omega(double t = 0) const {
    const BodyDynamics::State state = StateAt(t);
    return state.back().R_WL * state.back().twist.angular;
  }
  Vector3 VelocityOfC(double t = 0) const {
    const BodyDynamics::State state = StateAt(t);
    return state.back().R_WL * state.back().twist.linear;
  }
  Vector3 C(double t = 0) const { return StateAt(t).back().p_WL; }

  std::mt19937 random{31};
  Model model = testing::RandomTree(random, kSize);
  BodyDynamics dynamics{model};
  VectorX q = testing::RandomVector(random, kSize), v = testing::RandomVector(random, kSize),
          a = testing::RandomVector(random, kSize);
  ContactSurface surface;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_PAPER_ROLLING_TREE_H_
