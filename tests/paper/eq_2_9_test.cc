// Eq. (2.9): λ = 2 / √(¹n₂ᵀ A⁻¹ ¹n₂). The fraction bar is lost in the available text; the product reading is wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_9, IsAFraction) {
  const MovingEllipsoid body;
  const Vector3 squares = body.ellipsoid.semi_axes().cwiseAbs2();
  const Vector3 n_body = -body.nu(0);
  const double root = std::sqrt(n_body.dot(squares.cwiseProduct(n_body)));
  EXPECT_NEAR(root, body.ellipsoid.Support(body.nu(0)), 1e-15);
  const auto residual = [&](double lambda) {
    const Vector3 x = -lambda / 2 * squares.cwiseProduct(n_body);
    return x.cwiseAbs2().cwiseQuotient(squares).sum() - 1;  // Φ of (2.6)
  };
  EXPECT_NEAR(residual(2 / root), 0, 1e-15);
  EXPECT_GT(std::abs(residual(2 * root)), 0.05);
}

}  // namespace
}  // namespace rollgait
