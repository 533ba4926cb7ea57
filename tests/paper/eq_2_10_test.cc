// Eq. (2.10): ¹x = −A⁻¹ ¹n₂ / √(¹n₂ᵀ A⁻¹ ¹n₂), as printed: the point of the ellipsoid that lies lowest along n₂.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

TEST(Equation2_10, IsTheSupportPointOfTheLibraryAndTheLowestPoint) {
  const MovingEllipsoid body;
  const Vector3 n_body = -body.nu(0);
  const Vector3 squares = body.ellipsoid.semi_axes().cwiseAbs2();
  const Vector3 printed = -squares.cwiseProduct(n_body) / std::sqrt(n_body.dot(squares.cwiseProduct(n_body)));
  EXPECT_TRUE(MatrixNear(body.ellipsoid.SupportPoint(body.nu(0)), printed, 1e-15));
  SeededRandom random(210);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 other = body.ellipsoid.semi_axes().cwiseProduct(random.Unit());
    ASSERT_GE(n_body.dot(other), n_body.dot(printed) - 1e-15);
  }
}

}  // namespace
}  // namespace rollgait
