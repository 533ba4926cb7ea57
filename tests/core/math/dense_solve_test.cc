#include "core/math/dense_solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

MatrixX RandomMatrix(SeededRandom* random, int rows, int columns) {
  MatrixX a(rows, columns);
  for (int j = 0; j < columns; ++j) a.col(j) = random->VectorOf(rows, -1, 1);
  return a;
}

// Shapes and ranks: the defining properties, no second factorisation.
TEST(DenseSolve, LeastNormSolutionsAreMinimisersWithoutNullPart) {
  SeededRandom random(3);
  const std::array<int, 3> cases[] = {{5, 5, 5}, {4, 7, 4}, {7, 4, 4}, {6, 6, 3}, {8, 5, 2}, {3, 6, 2}};
  for (const auto& [rows, columns, rank] : cases) {
    const MatrixX a = RandomMatrix(&random, rows, rank) * RandomMatrix(&random, rank, columns);
    const VectorX b = random.VectorOf(rows, -1, 1);
    const LeastNormSolution solution = SolveLeastNorm(a, b, 1e-10);
    EXPECT_EQ(solution.rank, rank);
    EXPECT_LT((a.transpose() * (a * solution.x - b)).norm(), 1e-12);
    ASSERT_EQ(solution.null_space.cols(), columns - rank);
    EXPECT_LT((a * solution.null_space).norm(), 1e-12);
    EXPECT_LT((solution.null_space.transpose() * solution.x).norm(), 1e-12 * (1 + solution.x.norm()));
    MatrixX row_space, null_space;
    SplitRowSpace(a, 1e-10, &row_space, &null_space);
    EXPECT_EQ(row_space.cols(), rank);
    MatrixX both(columns, columns);
    both << row_space, null_space;
    EXPECT_TRUE(MatrixNear(both.transpose() * both, MatrixX::Identity(columns, columns), 1e-13));
    EXPECT_LT((a * null_space).norm(), 1e-12);
  }
}

TEST(DenseSolve, EigenvaluesOfARotationAndAShear) {
  MatrixX a = MatrixX::Zero(3, 3);
  a.topLeftCorner(2, 2) << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3);
  a(0, 2) = 5;
  a(2, 2) = -2;
  Eigen::VectorXcd values = Eigenvalues(a);
  std::sort(values.begin(), values.end(), [](auto x, auto y) { return x.imag() < y.imag(); });
  EXPECT_LT(std::abs(values[0] - std::polar(1.0, -0.3)), 1e-14);
  EXPECT_LT(std::abs(values[1] + 2.0), 1e-14);
  EXPECT_LT(std::abs(values[2] - std::polar(1.0, 0.3)), 1e-14);
}

}  // namespace
}  // namespace rollgait
