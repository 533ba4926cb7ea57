// Eq. (2.3): d(P₂P₁)/dt = 0 = v(P₁) − v(P₂). Only the second equality is rolling: the geometric points of a body that
// slides along the plane stay together, and its material point moves.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_3, ContactPersistsWhileSlipping) {
  MovingEllipsoid body;
  // Pure translation along the plane, in contact all the time: the gap n·C − h(ν) stays what it is.
  body.omega.setZero();
  body.alpha.setZero();
  body.a.setZero();
  body.v = body.n.cross(Vector3::UnitX());
  const auto gap = [&](double t) {
    return Eigen::Matrix<double, 1, 1>(body.n.dot(body.C(t)) - body.ellipsoid.Support(body.nu(t)));
  };
  EXPECT_NEAR(Derivative(gap)(0), 0, kDerivativeTolerance);
  // P₂ is the point of the plane below P₁; both move alike, so P₂P₁ does not change, and still the body slips.
  const auto between = [&](double t) { return Vector3(gap(t)(0) * body.n); };
  EXPECT_TRUE(MatrixNear(Derivative(between), Vector3::Zero(), kDerivativeTolerance));
  EXPECT_GT((body.v + body.omega.cross(body.CP(0))).norm(), 0.5);
}

}  // namespace
}  // namespace rollgait
