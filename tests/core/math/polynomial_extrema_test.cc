#include "core/math/polynomial_extrema.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/types.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// The second algorithm: real roots of the derivative in (0, 1) as eigenvalues of its companion matrix.
std::vector<double> CriticalPoints(const std::vector<double>& c) {
  std::vector<double> d;
  for (size_t j = 1; j < c.size(); ++j) d.push_back(static_cast<double>(j) * c[j]);
  const int n = static_cast<int>(d.size()) - 1;
  if (n < 1) return {};
  MatrixX companion = MatrixX::Zero(n, n);
  for (int i = 0; i < n; ++i) companion(i, n - 1) = -d[i] / d[n];
  for (int i = 1; i < n; ++i) companion(i, i - 1) = 1;
  std::vector<double> result;
  const Eigen::VectorXcd roots = Eigen::EigenSolver<MatrixX>(companion).eigenvalues();
  for (const std::complex<double>& root : roots) {
    if (std::abs(root.imag()) < 1e-6 && root.real() > 0 && root.real() < 1) result.push_back(root.real());
  }
  return result;
}

TEST(RangeOnUnitInterval, AgreesWithTheEigenvaluesOfTheCompanionMatrix) {
  SeededRandom random(4);
  int inside = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const int degree = 1 + trial % kLargestDegree;
    // Roots of the derivative in and around the interval, so that extrema within it are common.
    std::vector<double> derivative = {random.Uniform(-1, 1)};
    for (int i = 1; i < degree; ++i) {
      const double root = random.Uniform(-0.3, 1.3);
      derivative.push_back(0);
      for (int j = i; j >= 0; --j) derivative[j] = (j > 0 ? derivative[j - 1] : 0.0) - root * derivative[j];
    }
    std::vector<double> c = {random.Uniform(-1, 1)};
    for (int j = 0; j < degree; ++j) c.push_back(derivative[j] / (j + 1));
    const PolynomialRange range = RangeOnUnitInterval(c);
    double min = std::min(c[0], EvaluatePolynomial(c, 1)), max = std::max(c[0], EvaluatePolynomial(c, 1)), size = 0;
    for (double x : CriticalPoints(c)) {
      min = std::min(min, EvaluatePolynomial(c, x));
      max = std::max(max, EvaluatePolynomial(c, x));
    }
    for (double value : c) size += std::abs(value);
    EXPECT_NEAR(range.min, min, 1e-13 * size) << trial;
    EXPECT_NEAR(range.max, max, 1e-13 * size) << trial;
    EXPECT_EQ(EvaluatePolynomial(c, range.min_at), range.min);
    EXPECT_EQ(EvaluatePolynomial(c, range.max_at), range.max);
    inside += range.max_at > 0 && range.max_at < 1;
  }
  EXPECT_GT(inside, 800);
}

TEST(RangeOnUnitInterval, KnownExtrema) {
  // x (1 − x): largest in the middle, least at both ends, of which the first is said.
  PolynomialRange range = RangeOnUnitInterval(std::vector<double>{0, 1, -1});
  EXPECT_NEAR(range.max, 0.25, 1e-16);
  EXPECT_NEAR(range.max_at, 0.5, 1e-15);
  EXPECT_EQ(range.min, 0);
  EXPECT_EQ(range.min_at, 0);
  // Leading coefficients that vanish, a constant, a straight line.
  range = RangeOnUnitInterval(std::vector<double>{0, 1, -1, 0, 0});
  EXPECT_NEAR(range.max, 0.25, 1e-16);
  EXPECT_EQ(RangeOnUnitInterval(std::vector<double>{3}).max, 3);
  EXPECT_EQ(RangeOnUnitInterval(std::vector<double>{3, 0, 0}).min, 3);
  range = RangeOnUnitInterval(std::vector<double>{1, -3});
  EXPECT_EQ(range.min, -2);
  EXPECT_EQ(range.min_at, 1);
  EXPECT_EQ(range.max, 1);
  // A triple root of the derivative: (x − 0.3)^4.
  range = RangeOnUnitInterval(std::vector<double>{0.0081, -0.108, 0.54, -1.2, 1});
  EXPECT_NEAR(range.min, 0, 1e-16);
  EXPECT_NEAR(range.min_at, 0.3, 1e-3);
}

// 1 − 10⁶ (x − x₀)²: positive within a thousandth of x₀ only.
TEST(RangeOnUnitInterval, APeakBetweenAnyTwoSamples) {
  for (double at : {1e-5, 0.12345, 0.999995}) {
    const double steep = 1e6;
    const PolynomialRange range = RangeOnUnitInterval(std::vector<double>{1 - steep * at * at, 2 * steep * at, -steep});
    EXPECT_NEAR(range.max, 1, 1e-9);
    EXPECT_NEAR(range.max_at, at, 1e-12);
  }
}

TEST(SignChanges, OfAChebyshevPolynomial) {
  // T_8(2x − 1), with all of its eight roots in the interval.
  const std::vector<double> c = {1, -128, 2688, -21504, 84480, -180224, 212992, -131072, 32768};
  double roots[8];
  ASSERT_EQ(SignChangesOnUnitInterval(c, roots), 8);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(roots[i], 0.5 - 0.5 * std::cos(M_PI * (i + 0.5) / 8), 1e-12);
  // A double root is no change of sign; a root on a root of the derivative is one if it is triple.
  EXPECT_EQ(SignChangesOnUnitInterval(std::vector<double>{0.25, -1, 1}, roots), 0);
  ASSERT_EQ(SignChangesOnUnitInterval(std::vector<double>{-0.125, 0.75, -1.5, 1}, roots), 1);
  EXPECT_NEAR(roots[0], 0.5, 1e-5);
}

TEST(RangeOnUnitInterval, WhatIsNotFiniteHasNoRange) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity}) {
    const PolynomialRange range = RangeOnUnitInterval(std::vector<double>{0, bad, 1});
    EXPECT_EQ(range.min, -kInfinity);
    EXPECT_EQ(range.max, kInfinity);
  }
}

}  // namespace
}  // namespace rollgait
