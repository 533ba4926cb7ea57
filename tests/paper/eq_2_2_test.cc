// Eq. (2.2): v(P) ≜ d(OP)/dt = v(C) + ω × CP. The right-hand side is the velocity of the material point at P; the
// middle is that of the geometric point, which also runs over the surface: d(OP)/dt = v(P) + S (ω × n).
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_2, MaterialAndGeometricPointHaveDifferentVelocities) {
  const MovingEllipsoid body;
  const Vector3 geometric = Derivative([&](double t) { return Vector3(body.C(t) + body.CP(t)); });
  const Vector3 body_point = body.R0.transpose() * body.CP(0);
  const Vector3 material = Derivative([&](double t) { return Vector3(body.C(t) + body.R(t) * body_point); });
  const Vector3 printed = body.v + body.omega.cross(body.CP(0));
  EXPECT_TRUE(MatrixNear(printed, material, kDerivativeTolerance));
  EXPECT_TRUE(MatrixNear(printed + body.S() * body.omega.cross(body.n), geometric, kDerivativeTolerance));
  EXPECT_GT((printed - geometric).norm(), 0.1);  // m/s: the printed equality does not hold
}

}  // namespace
}  // namespace rollgait
