#include "core/nlp/frontal_ldlt.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

#include "tests/support/allocation_counter.h"

namespace rollgait {
namespace {

// A symmetric matrix with its pattern (lower triangle, some entries split in two) and groups.
struct Sample {
  MatrixX dense;
  SparsityPattern pattern;
  std::vector<double> values;
  std::vector<int> groups;

  explicit Sample(int size) : dense(MatrixX::Zero(size, size)), groups(static_cast<size_t>(size), 0) {}
  int size() const { return static_cast<int>(dense.rows()); }
  void Add(int row, int column, double value) {
    pattern.Add(row, column);
    values.push_back(value);
    dense(row, column) += value;
    if (row != column) dense(column, row) += value;
  }
};

// The Newton matrix of a chain: stages with `states` states, `controls` controls and `rows` equations between a stage,
// the next one and its controls; the last group is a border that meets everything. The first state closes the ring.
Sample Chain(int stages, int states, int controls, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int width = states + controls + rows, border = 2;
  Sample sample(stages * width + states + border);
  const int last = sample.size();
  const auto meets = [&](int a, int b, double scale) {
    sample.Add(std::max(a, b), std::min(a, b), scale * uniform(random));
  };
  for (int k = 0; k < stages; ++k) {
    const int x = k * width, u = x + states, y = u + controls, next = (k + 1) * width;
    for (int i = x; i < y; ++i) {
      for (int j = x; j <= i; ++j) meets(i, j, 1);
      sample.Add(i, i, 0.1);
      meets(last - 1, i, 1);
    }
    for (int i = y; i < next; ++i) {
      for (int j = x; j < y; ++j) meets(i, j, 1);
      for (int j = 0; j < states; ++j) meets(next + j, i, 1);
      meets(last - 2, i, 1);
      sample.Add(i, i, 0);
    }
    for (int i = x; i < next; ++i) sample.groups[static_cast<size_t>(i)] = k;
  }
  for (int i = 0; i < states; ++i) {
    const int end = stages * width + i;
    sample.Add(end, end, 1 + uniform(random));
    sample.Add(end, i, 1);
    sample.groups[static_cast<size_t>(end)] = stages;
  }
  for (int b = 1; b <= border; ++b) {
    sample.Add(last - b, last - b, uniform(random));
    sample.groups[static_cast<size_t>(last - b)] = stages + 1;
  }
  return sample;
}

FrontalLdlt::Inertia EigenInertia(const MatrixX& matrix) {
  const VectorX values = Eigen::SelfAdjointEigenSolver<MatrixX>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  FrontalLdlt::Inertia inertia;
  for (double value : values) ++(value > 0 ? inertia.positive : inertia.negative);
  return inertia;
}

// Backward error of a solve; the pivoting bounds growth by a moderate power of 1/threshold only, so the limits are
// generous.
double BackwardError(const Sample& sample, FrontalLdlt* factors) {
  const VectorX right = VectorX::LinSpaced(sample.size(), -1, 2);
  VectorX x = right;
  factors->Solve(x.data());
  return (sample.dense * x - right).lpNorm<Eigen::Infinity>() /
         (sample.dense.cwiseAbs().rowwise().sum().maxCoeff() * x.lpNorm<Eigen::Infinity>());
}

struct Shape {
  int stages, states, controls, rows;
};
class FrontalLdltTest : public ::testing::TestWithParam<Shape> {};

// More rows than controls: pivots must be delayed from stage to stage.
INSTANTIATE_TEST_SUITE_P(Chains, FrontalLdltTest,
                         ::testing::Values(Shape{1, 2, 1, 1}, Shape{5, 4, 3, 3}, Shape{8, 6, 2, 5}, Shape{12, 3, 9, 1},
                                           Shape{6, 18, 4, 10}));

TEST_P(FrontalLdltTest, SolvesAndCountsEigenvaluesLikeDenseAlgebra) {
  const auto [stages, states, controls, rows] = GetParam();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Sample sample = Chain(stages, states, controls, rows, seed);
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
    for (double threshold : {1e-6, 1e-2, 0.4}) {
      const auto inertia = factors.Factorise(sample.values.data(), threshold);
      const auto expected = EigenInertia(sample.dense);
      EXPECT_EQ(inertia.zero, 0) << seed;
      EXPECT_EQ(inertia.negative, expected.negative) << seed;
      EXPECT_EQ(inertia.positive, expected.positive) << seed;
      EXPECT_LT(BackwardError(sample, &factors), threshold < 1e-4 ? 1e-11 : 1e-14) << seed << " " << threshold;
    }
  }
}

// The order of elimination is the caller's affair: any grouping gives the same answers.
TEST(FrontalLdlt, AnyGroupingIsRight) {
  Sample sample = Chain(6, 4, 3, 3, 7);
  std::mt19937 random(3);
  const auto expected = EigenInertia(sample.dense);
  int delayed = 0;
  for (int trial = 0; trial < 50; ++trial) {
    for (int& group : sample.groups) group = static_cast<int>(random() % 9);
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
    const auto inertia = factors.Factorise(sample.values.data(), 1e-3);
    EXPECT_EQ(inertia.negative, expected.negative);
    EXPECT_EQ(inertia.zero, 0);
    EXPECT_LT(BackwardError(sample, &factors), 1e-13);
    delayed += factors.delayed_pivots();
  }
  EXPECT_GT(delayed, 0) << "no trial needed what this test is about";
}

// Sparse enough that the children of a front reach differently far, and none of them everywhere; what an earlier
// factorisation has left in the fronts must not show.
// Terms w a aᵀ whose unknowns are of one group or of several, of weights that are far apart.
TEST(FrontalLdlt, TakesOuterProducts) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Sample sample = Chain(5, 4, 3, 3, static_cast<unsigned>(trial));
    if (trial % 2 == 1) {
      for (int& group : sample.groups) group = static_cast<int>(random() % 6);
    }
    OuterProducts products;
    std::vector<double> vectors, weights;
    for (int k = 0; k < 12; ++k) {
      const int first = static_cast<int>(random() % static_cast<unsigned>(sample.size() - 20));
      VectorX a = VectorX::Zero(sample.size());
      const int entries = k % 5;  // none, too
      for (int i = 0; i < entries; ++i) {
        const int unknown = first + 4 * ((3 * i) % 5);
        products.Add(unknown, static_cast<int>(vectors.size()));
        vectors.push_back(uniform(random));
        a(unknown) = vectors.back();
      }
      products.EndTerm();
      weights.push_back(std::pow(10.0, 2 * uniform(random)));
      sample.dense += weights.back() * a * a.transpose();
    }
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups, products);
    for (int repetition = 0; repetition < 2; ++repetition) {
      const auto inertia = factors.Factorise(sample.values.data(), 0.1, {vectors.data(), weights.data()});
      const auto expected = EigenInertia(sample.dense);
      EXPECT_EQ(inertia.negative, expected.negative) << trial;
      EXPECT_EQ(inertia.positive, expected.positive) << trial;
      EXPECT_LT(BackwardError(sample, &factors), 1e-13) << trial;
    }
  }
}

TEST(FrontalLdlt, ForgetsEarlierValues) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Sample sample(40);
    for (int i = 0; i < sample.size(); ++i) {
      sample.Add(i, i, 1 + uniform(random));
      const int other = static_cast<int>(random() % 40);
      sample.Add(std::max(i, other), std::min(i, other), uniform(random));
      sample.groups[static_cast<size_t>(i)] = static_cast<int>(random() % 12);
    }
    std::vector<double> earlier;
    for (double value : sample.values) earlier.push_back(1e3 * (value + uniform(random)));
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
    factors.Factorise(earlier.data(), 1e-2);
    const auto inertia = factors.Factorise(sample.values.data(), 1e-2);
    EXPECT_EQ(inertia.negative, EigenInertia(sample.dense).negative) << trial;
    EXPECT_LT(BackwardError(sample, &factors), 1e-13) << trial;
  }
}

TEST(FrontalLdlt, AllocatesNothingTheSecondTime) {
  Sample sample = Chain(6, 18, 4, 10, 2);
  std::mt19937 random(3);
  for (int& group : sample.groups) group = static_cast<int>(random() % 9);
  FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
  VectorX x = VectorX::Ones(sample.size());
  const auto factor_and_solve = [&] {
    const long before = Allocations();
    factors.Factorise(sample.values.data(), 0.1);
    factors.Solve(x.data());
    return Allocations() - before;
  };
  EXPECT_GT(factor_and_solve(), 0) << "the counter counts nothing";
  EXPECT_GT(factors.delayed_pivots(), 0) << "no front is wider than its own columns";
  EXPECT_EQ(factor_and_solve(), 0);
}

// A diagonal entry too small beside its neighbour makes a pivot of order 2, also where the block is definite.
TEST(FrontalLdlt, CountsEigenvaluesOfDefinitePivotsOfOrderTwo) {
  for (const double sign : {1.0, -1.0}) {
    for (const double last : {10.0, 30.0, 50.0}) {  // determinant −0.5, 0.5, 1.5
      Sample sample(2);
      sample.Add(0, 0, sign * 0.05);
      sample.Add(1, 0, 1);
      sample.Add(1, 1, sign * last);
      FrontalLdlt factors(2, sample.pattern, sample.groups);
      const auto inertia = factors.Factorise(sample.values.data(), 0.1);
      const auto expected = EigenInertia(sample.dense);
      EXPECT_EQ(inertia.negative, expected.negative) << sign << " " << last;
      EXPECT_EQ(inertia.positive, expected.positive) << sign << " " << last;
      EXPECT_LT(BackwardError(sample, &factors), 1e-15);
    }
  }
}

TEST(FrontalLdlt, SaysHowManyPivotsAreMissing) {
  Sample sample = Chain(4, 3, 2, 2, 11);
  const int repeated = 2 + 3, row = 3 + 2;  // the two rows of the first stage become one
  for (size_t e = 0; e < sample.values.size(); ++e) {
    if (sample.pattern.rows[e] == row || sample.pattern.columns[e] == row) sample.values[e] = 0;
  }
  ASSERT_EQ(repeated, row);
  FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
  EXPECT_EQ(factors.Factorise(sample.values.data(), 1e-6).zero, 1);
}

// Where no pivot is found the unknowns are not all carried to the last front, whose memory grows with their square.
TEST(FrontalLdlt, EndsEarlyWhereNothingIsAPivot) {
  for (const double value : {0.0, std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
    Sample sample = Chain(200, 4, 3, 4, 1);
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
    const std::vector<double> good = sample.values;
    std::fill(sample.values.begin(), sample.values.end(), value);
    const FrontalLdlt::Inertia inertia = factors.Factorise(sample.values.data(), 0.01);
    EXPECT_GT(inertia.zero, 0) << value;
    EXPECT_LT(inertia.zero, 600) << value << ": of " << sample.size();
    EXPECT_EQ(factors.Factorise(good.data(), 0.01).zero, 0) << "after " << value;
    EXPECT_LT(BackwardError(sample, &factors), 1e-9) << "after " << value;
  }
}

TEST(FrontalLdlt, WorkGrowsLinearlyWithTheStages) {
  const auto entries = [](int stages) {
    const Sample sample = Chain(stages, 6, 4, 4, 5);
    FrontalLdlt factors(sample.size(), sample.pattern, sample.groups);
    factors.Factorise(sample.values.data(), 1e-6);
    return factors.factor_entries();
  };
  const double ten = static_cast<double>(entries(10)), forty = static_cast<double>(entries(40));
  EXPECT_LT(forty, 4.4 * ten);
}

TEST(FrontalLdlt, RepeatsItselfToTheLastBit) {
  const Sample sample = Chain(6, 6, 4, 4, 9);
  VectorX first = VectorX::Ones(sample.size()), second = first;
  FrontalLdlt once(sample.size(), sample.pattern, sample.groups), again(sample.size(), sample.pattern, sample.groups);
  once.Factorise(sample.values.data(), 1e-6);
  once.Solve(first.data());
  again.Factorise(sample.values.data(), 1e-6);
  again.Factorise(sample.values.data(), 1e-6);
  again.Solve(second.data());
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace rollgait
