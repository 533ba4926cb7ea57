// Eq. (2.8): 2 A ¹x = −λ ¹n₂  ⇔  ¹x = −(λ/2) A⁻¹ ¹n₂, as printed. n₂ points out of the ground, so λ > 0.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_8, BothFormsHoldAtTheLowestPoint) {
  const MovingEllipsoid body;
  const Vector3 squares = body.ellipsoid.semi_axes().cwiseAbs2();
  const Vector3 x = body.ellipsoid.SupportPoint(body.nu(0)), n_body = -body.nu(0);
  const double lambda = -2 * x.cwiseQuotient(squares).dot(n_body);
  EXPECT_GT(lambda, 0);
  EXPECT_TRUE(MatrixNear(2 * x.cwiseQuotient(squares), -lambda * n_body, 1e-14));
  EXPECT_TRUE(MatrixNear(x, -lambda / 2 * squares.cwiseProduct(n_body), 1e-14));
  // With the normal into the ground (λ < 0 would be needed) the same formula gives the highest point.
  EXPECT_GT(n_body.dot(Vector3(lambda / 2 * squares.cwiseProduct(n_body))), n_body.dot(x));
}

}  // namespace
}  // namespace rollgait
