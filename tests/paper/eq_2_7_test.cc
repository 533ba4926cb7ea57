// Eq. (2.7): ∇Φ(¹x) = −λ ¹T₂ n₂ with λ > 0. A normal turns with the rotation part only, ¹n₂ = ¹R₂ n₂, and "iff" is
// "if": a body that hovers satisfies it too; contact needs gap = 0 besides.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_7, HoldsForDirectionsAndIsNotSufficient) {
  const MovingEllipsoid body;
  const Vector3 x = body.ellipsoid.SupportPoint(body.nu(0));
  const Vector3 gradient = 2 * x.cwiseQuotient(body.ellipsoid.semi_axes().cwiseAbs2());
  const double lambda = gradient.norm();
  const Vector3 n_body = body.R0.transpose() * body.n;
  EXPECT_TRUE(MatrixNear(gradient, -lambda * n_body, 1e-14));
  // Moved as a point by the whole transformation world -> body, the normal would not be parallel to the gradient.
  const Vector3 as_point = body.R0.transpose() * (body.n - body.C(0));
  EXPECT_GT(gradient.cross(as_point).norm(), 0.1 * gradient.norm() * as_point.norm());
  // This body hovers: the condition is satisfied, and there is no contact.
  const double gap = body.n.dot(body.C(0)) - body.ellipsoid.Support(body.nu(0));
  EXPECT_NEAR(gap, body.n.dot(body.C(0) + body.CP(0)), 1e-15);
  EXPECT_GT(gap, 0.1);
}

}  // namespace
}  // namespace rollgait
