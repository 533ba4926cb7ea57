#include "core/nlp/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/base/types.h"

namespace rollgait {
namespace {

struct Sample {
  SparsityPattern pattern;
  VectorX values;
  MatrixX dense;
};

// Entries of either triangle, with duplicates, some columns and rows empty.
Sample MakeSample(int size, int entries) {
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> place(0, size - 1);
  Sample sample{{}, VectorX::Random(entries), MatrixX::Zero(size, size)};
  for (int e = 0; e < entries; ++e) {
    const int row = place(generator), column = e % 3 == 0 ? row : place(generator);
    sample.pattern.Add(row, column);
    sample.dense(row, column) += sample.values(e);
    if (row != column) sample.dense(column, row) += sample.values(e);
  }
  return sample;
}

TEST(SymmetricMatrix, MultipliesLikeDenseAlgebra) {
  for (const int entries : {0, 1, 20, 400}) {
    const Sample sample = MakeSample(30, entries);
    SymmetricMatrix matrix(30, sample.pattern);
    matrix.Assign(sample.values.data());
    const VectorX x = VectorX::Random(30);
    VectorX y = VectorX::Constant(30, 5);
    matrix.Multiply(x, &y);
    // Sums of at most 400 products of numbers below 1.
    EXPECT_LT((y - sample.dense * x).cwiseAbs().maxCoeff(), 1e-13) << entries << " entries";
  }
}

TEST(SymmetricMatrix, KeepsTheLowerTriangleByColumns) {
  const Sample sample = MakeSample(30, 400);
  SymmetricMatrix matrix(30, sample.pattern);
  matrix.Assign(sample.values.data());
  const SparsityPattern& sorted = matrix.pattern();
  ASSERT_EQ(sorted.size(), 400);
  for (int k = 0; k < 400; ++k) {
    EXPECT_GE(sorted.rows[k], sorted.columns[k]);
    EXPECT_GE(sorted.columns[k], sorted.columns[std::max(k - 1, 0)]);
  }
  for (int e = 0; e < 400; ++e) {
    const int k = matrix.place(e), row = sample.pattern.rows[e], column = sample.pattern.columns[e];
    EXPECT_EQ(sorted.rows[k], std::max(row, column));
    EXPECT_EQ(sorted.columns[k], std::min(row, column));
    EXPECT_EQ(matrix.values()[k], sample.values(e));
  }
}

}  // namespace
}  // namespace rollgait
