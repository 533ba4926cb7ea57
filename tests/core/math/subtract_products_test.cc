#include "core/math/subtract_products.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/base/types.h"

namespace rollgait {
namespace {

constexpr int kStrideExcess = 3;
constexpr double kGuard = 1234;  // what lies between columns stays as it was

MatrixX Random(int rows, int columns) { return MatrixX::Random(rows, columns); }

// Rows 0 … n − 1 of the result are those expected, the others untouched. Sums of at most 40 products of numbers
// below 1.
void ExpectRows(const MatrixX& result, const MatrixX& expected, int n) {
  EXPECT_LT((result.topRows(n) - expected).cwiseAbs().sum(), 1e-13 * (1 + n * expected.cols()));
  EXPECT_TRUE((result.bottomRows(result.rows() - n).array() == kGuard).all());
}

struct Size {
  int n, columns, count;
};

// All remainders of tiles of 24, 12, 8 and 4 rows and of 8 and 4 columns.
class SubtractProductsTest : public ::testing::TestWithParam<Size> {
 protected:
  void SetUp() override {
    const auto [n, columns, count] = GetParam();
    l_ = Random(n + kStrideExcess, count);
    w_ = Random(columns + kStrideExcess, count);
    y_ = Random(n + kStrideExcess, columns);
    y_.bottomRows(kStrideExcess).setConstant(kGuard);
    expected_ = y_.topRows(n) - l_.topRows(n) * w_.topRows(columns).transpose();
  }
  MatrixX l_, w_, y_, expected_;
};

std::vector<Size> Sizes() {
  std::vector<Size> sizes;
  for (int n = 0; n <= 37; ++n) {
    for (int columns : {0, 1, 3, 4, 6, 9, 13}) {
      for (int count : {0, 1, 7, 8, 15, 40}) sizes.push_back({n, columns, count});
    }
  }
  return sizes;
}
INSTANTIATE_TEST_SUITE_P(Sizes, SubtractProductsTest, ::testing::ValuesIn(Sizes()));

TEST_P(SubtractProductsTest, Matrix) {
  const auto [n, columns, count] = GetParam();
  SubtractProductMatrix(l_.data(), n + kStrideExcess, w_.data(), columns + kStrideExcess, count, n, columns, y_.data(),
                        n + kStrideExcess);
  ExpectRows(y_, expected_, n);
}

TEST_P(SubtractProductsTest, Columns) {
  const auto [n, columns, count] = GetParam();
  if (count > 2) {
    w_.col(2).setZero();  // numbers that are zero are passed over
    expected_ = y_.topRows(n) - l_.topRows(n) * w_.topRows(columns).transpose();
  }
  for (int j = 0; j < columns; ++j) {
    SubtractProducts(l_.data(), n + kStrideExcess, w_.data() + j, columns + kStrideExcess, count, n, y_.col(j).data());
  }
  ExpectRows(y_, expected_, n);
}

TEST_P(SubtractProductsTest, Triangle) {
  const auto [n, columns, count] = GetParam();
  const MatrixX w = Random(n + kStrideExcess, count);
  MatrixX y = Random(n + kStrideExcess, n);
  y.bottomRows(kStrideExcess).setConstant(kGuard);
  MatrixX expected = y.topRows(n) - l_.topRows(n) * w.topRows(n).transpose();
  SubtractProductTriangle(l_.data(), n + kStrideExcess, w.data(), n + kStrideExcess, count, n, y.data(),
                          n + kStrideExcess);
  for (int j = 1; j < n; ++j) y.col(j).head(j) = expected.col(j).head(j);
  ExpectRows(y, expected, n);
}

TEST_P(SubtractProductsTest, Transposed) {
  const auto [n, columns, count] = GetParam();
  const VectorX x = VectorX::Random(n);
  VectorX y = VectorX::Random(count);
  const VectorX expected = y - l_.topRows(n).transpose() * x;
  SubtractTransposedProduct(l_.data(), n + kStrideExcess, count, n, x.data(), y.data());
  EXPECT_LT((y - expected).cwiseAbs().sum(), 1e-13 * (1 + count));
}

// Every set that this processor has, not only the one that is called.
TEST_P(SubtractProductsTest, InstructionSets) {
  const auto [n, columns, count] = GetParam();
  const int stride = n + kStrideExcess, w_stride = columns + kStrideExcess;
  const VectorX x = VectorX::Random(n);
  const VectorX dots = VectorX::Random(count);
  for (const ProductKernels* kernels : AvailableProductKernels()) {
    MatrixX y = y_;
    kernels->matrix(l_.data(), stride, w_.data(), w_stride, count, n, columns, y.data(), stride, 0);
    ExpectRows(y, expected_, n);
    y = y_;
    for (int j = 0; j < columns; ++j) {
      kernels->column(l_.data(), stride, nullptr, w_.data() + j, w_stride, count, n, y.col(j).data());
    }
    ExpectRows(y, expected_, n);
    VectorX sums = dots;
    kernels->transposed(l_.data(), stride, count, n, x.data(), sums.data());
    EXPECT_LT((sums - dots + l_.topRows(n).transpose() * x).cwiseAbs().sum(), 1e-13 * (1 + count));
  }
}

TEST(LargestMagnitude, IsThatOfAnyPlace) {
  for (const ProductKernels* kernels : AvailableProductKernels()) {
    EXPECT_EQ(kernels->largest(nullptr, 0), 0);
    for (int n = 1; n <= 70; ++n) {
      for (int place = 0; place < n; ++place) {
        VectorX x = VectorX::Random(n);
        x(place) = place % 2 == 0 ? 3.5 : -3.5;
        ASSERT_EQ(kernels->largest(x.data(), n), 3.5) << kernels->name << ", " << place << " of " << n;
      }
    }
  }
}

TEST(LargestMagnitude, PassesOverWhatIsNoNumber) {
  VectorX x = VectorX::Constant(40, -2);
  x(0) = x(17) = x(39) = std::numeric_limits<double>::quiet_NaN();
  for (const ProductKernels* kernels : AvailableProductKernels())
    EXPECT_EQ(kernels->largest(x.data(), 40), 2) << kernels->name;
  EXPECT_EQ(LargestMagnitude(x.data(), 40), 2);
}

TEST(ScaleAndKeep, TouchesWhatItIsGiven) {
  for (const ProductKernels* kernels : AvailableProductKernels()) {
    for (int n = 0; n <= 40; ++n) {
      const VectorX before = VectorX::Random(n + 1);
      VectorX x = before, kept = VectorX::Constant(n + 1, kGuard);
      kernels->scale(-0.3, n, x.data(), kept.data());
      EXPECT_EQ(x.head(n), -0.3 * before.head(n)) << kernels->name << ", " << n;
      EXPECT_EQ(kept.head(n), before.head(n)) << kernels->name << ", " << n;
      EXPECT_EQ(x(n), before(n));
      EXPECT_EQ(kept(n), kGuard);
    }
  }
}

}  // namespace
}  // namespace rollgait
