// Eq. (3.10): the contact force as multiplier of Gauss's principle, min ½ |q̈ − M⁻¹(Sᵀu − b)|²_M subject to J q̈ + γ = 0.
// The printed text lacks the brackets and the ½; without ½ the multiplier is twice the force.
#include <gtest/gtest.h>

#include <Eigen/QR>

#include "tests/paper/contact_solution.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_10, AccelerationIsTheConstrainedMinimumAndTheForceItsMultiplier) {
  const ContactSolution s;
  const VectorX free = s.mass.llt().solve(s.tau - s.bias);
  // Stationarity of ½ |·|²_M − λᵀ (J q̈ + γ).
  const VectorX gradient = s.mass * (s.acceleration - free);
  EXPECT_TRUE(MatrixNear(gradient, s.jacobian.transpose() * s.lambda, 1e-10));
  // Without the ½ the gradient doubles, and so does the multiplier.
  const VectorX multiplier = s.jacobian.transpose().colPivHouseholderQr().solve(2 * gradient);
  EXPECT_TRUE(MatrixNear(multiplier, 2 * s.lambda, 1e-9));
  // Every admissible change of q̈ makes the distance larger.
  const Eigen::FullPivHouseholderQR<MatrixX> qr(s.jacobian.transpose());
  const MatrixX null_space = MatrixX(qr.matrixQ()).rightCols(s.jacobian.cols() - qr.rank());
  const auto distance = [&](const VectorX& a) { return (a - free).dot(s.mass * (a - free)); };
  for (Eigen::Index i = 0; i < null_space.cols(); ++i) {
    EXPECT_GT(distance(s.acceleration + 1e-3 * null_space.col(i)), distance(s.acceleration));
    EXPECT_GT(distance(s.acceleration - 1e-3 * null_space.col(i)), distance(s.acceleration));
  }
}

TEST(Equation3_10, BracketsMatter) {
  const ContactSolution s;
  const VectorX without_brackets = s.mass.llt().solve(s.tau) - s.bias;
  const VectorX gradient = s.mass * (s.acceleration - without_brackets);
  const VectorX multiplier = s.jacobian.transpose().colPivHouseholderQr().solve(gradient);
  EXPECT_GT((s.jacobian.transpose() * multiplier - gradient).norm(), 0.1 * gradient.norm());
}

}  // namespace
}  // namespace rollgait
