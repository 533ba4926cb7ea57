// Eq. (2.5): dv(P)/dt = a(C) + ω̇ × CP + ω × d(CP)/dt, with the absolute derivative d(CP)/dt = ω × CP + S (ω × n). The
// paper calls it the acceleration of a fixed material point; that one lacks the S term.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_5, IsTheRateOfTheContactPointsMaterialVelocity) {
  const MovingEllipsoid body;
  // Velocity of whatever material point is at P at time t; the motion's own derivative stands in for (v, ω) at t.
  const auto velocity = [&](double t) {
    const Vector3 body_point = body.R(t).transpose() * body.CP(t);
    return Vector3(Derivative([&](double dt) { return Vector3(body.C(t + dt) + body.R(t + dt) * body_point); }));
  };
  const Vector3 rate = Derivative(velocity);
  const Vector3 r = body.CP(0);
  const Vector3 common = body.a + body.alpha.cross(r);
  const Vector3 r_rate = body.omega.cross(r) + body.S() * body.omega.cross(body.n);
  // Two differences: the inner one's error (1e-10) is divided by the outer step.
  EXPECT_TRUE(MatrixNear(common + body.omega.cross(r_rate), rate, 1e-6));
  const Vector3 fixed_material_point = common + body.omega.cross(body.omega.cross(r));
  EXPECT_GT((fixed_material_point - rate).norm(), 0.05 * rate.norm());
}

}  // namespace
}  // namespace rollgait
