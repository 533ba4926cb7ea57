// Eq. (2.11): Ȧ⁻¹ = ω × A⁻¹ − A⁻¹ ω ×, right in axes fixed to the world, where A⁻¹ = R B Rᵀ. In body axes A⁻¹ is
// constant and the normal moves: ¹ṅ₂ = −ω × ¹n₂.
#include <gtest/gtest.h>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_11, HoldsInWorldAxes) {
  const MovingEllipsoid body;
  const Matrix3 rate = Derivative([&](double t) { return Matrix3(body.InverseA(t)); });
  const Matrix3 inverse_a = body.InverseA(0);
  const Matrix3 printed = Skew(body.omega) * inverse_a - inverse_a * Skew(body.omega);
  EXPECT_TRUE(MatrixNear(printed, rate, kDerivativeTolerance));
  EXPECT_GT(rate.norm(), 1);
}

TEST(Equation2_11, InBodyAxesTheNormalMoves) {
  const MovingEllipsoid body;
  const Vector3 rate = Derivative([&](double t) { return Vector3(body.R(t).transpose() * body.n); });
  const Vector3 omega_body = body.R0.transpose() * body.omega, n_body = body.R0.transpose() * body.n;
  EXPECT_TRUE(MatrixNear(-omega_body.cross(n_body), rate, kDerivativeTolerance));
}

}  // namespace
}  // namespace rollgait
