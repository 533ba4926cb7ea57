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

// Entries of either triangle, with duplicates, some columns and rows empty; every seventh belongs to nobody.
Sample MakeSample(int size, int entries) {
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> place(0, size - 1);
  Sample sample{{}, VectorX::Random(entries), MatrixX::Zero(size, size)};
  for (int e = 0; e < entries; ++e) {
    const int row = place(generator), column = e % 3 == 0 ? row : place(generator);
    if (e % 7 == 6) {
      sample.pattern.Add(e % 2 == 0 ? -1 : row, e % 2 == 0 ? column : -1);
      continue;
    }
    sample.pattern.Add(row, column);
    sample.dense(row, column) += sample.values(e);
    if (row != column) sample.dense(column, row) += sample.values(e);
  }
  return sample;
}

TEST(SymmetricMatrix, MultipliesLikeDenseAlgebra) {
  for (const int entries : {0, 1, 20, 400}) {
    Sample sample = MakeSample(30, entries);
    SymmetricMatrix matrix(30, sample.pattern);
    for (int j = 0; j < 30; ++j) {
      matrix.diagonal(j) = 0.1 * j;
      sample.dense(j, j) += 0.1 * j;
    }
    matrix.Assign(sample.values.data());
    const VectorX x = VectorX::Random(30);
    VectorX y = VectorX::Constant(30, 5);
    matrix.Multiply(x.data(), y.data());
    // Sums of at most 430 products of numbers below 3.
    EXPECT_LT((y - sample.dense * x).cwiseAbs().maxCoeff(), 1e-13) << entries << " entries";
  }
}

TEST(SymmetricMatrix, KeepsTheLowerTriangleByColumnsAndRows) {
  const Sample sample = MakeSample(30, 400);
  SymmetricMatrix matrix(30, sample.pattern);
  matrix.Assign(sample.values.data());
  const SparsityPattern& sorted = matrix.pattern();
  ASSERT_EQ(sorted.size(), 400 - 400 / 7 + 30);
  for (int k = 0; k < sorted.size(); ++k) {
    EXPECT_GE(sorted.rows[k], sorted.columns[k]);
    const bool is_first = k == 0 || sorted.columns[k - 1] < sorted.columns[k];
    if (is_first) {
      EXPECT_EQ(&matrix.diagonal(sorted.columns[k]), &matrix.values()[k]);
      EXPECT_EQ(sorted.rows[k], sorted.columns[k]);
    } else {
      EXPECT_EQ(sorted.columns[k - 1], sorted.columns[k]);
      EXPECT_LE(sorted.rows[k - 1], sorted.rows[k]);
    }
  }
  MatrixX dense = MatrixX::Zero(30, 30);
  for (int k = 0; k < sorted.size(); ++k) {
    const int row = sorted.rows[k], column = sorted.columns[k];
    dense(row, column) += matrix.values()[k];
    if (row != column) dense(column, row) += matrix.values()[k];
  }
  EXPECT_LT((dense - sample.dense).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace rollgait
