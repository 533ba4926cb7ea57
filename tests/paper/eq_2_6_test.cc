// Eq. (2.6): Φ(x) = xᵀ A x − 1, as printed; negative inside, so that its gradient points out of the body.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_6, VanishesOnTheSurfaceAndGrowsOutwards) {
  const MovingEllipsoid body;
  const Vector3 inverse_squares = body.ellipsoid.semi_axes().cwiseAbs2().cwiseInverse();
  const auto phi = [&](const Vector3& x) { return x.cwiseAbs2().dot(inverse_squares) - 1; };
  const Vector3 x = body.ellipsoid.SupportPoint(body.nu(0));
  EXPECT_NEAR(phi(x), 0, 1e-15);
  EXPECT_LT(phi(0.9 * x), -0.1);
  EXPECT_GT(phi(1.1 * x), 0.1);
  // Its gradient at x(ν) has the direction ν.
  const Vector3 gradient = 2 * inverse_squares.cwiseProduct(x);
  EXPECT_TRUE(MatrixNear(gradient.normalized(), body.nu(0), 1e-15));
}

}  // namespace
}  // namespace rollgait
