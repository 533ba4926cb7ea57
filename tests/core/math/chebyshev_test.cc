#include "core/math/chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rollgait {
namespace {

MatrixX Interpolate(const ChebyshevBasis& basis, double (*f)(double)) {
  MatrixX values(1, basis.size()), coefficients;
  for (int i = 0; i < basis.size(); ++i) values(0, i) = f(basis.node(i));
  basis.Coefficients(values, &coefficients);
  return coefficients;
}

TEST(ChebyshevBasis, ReproducesPolynomialsOfItsDegree) {
  const ChebyshevBasis basis(5, 20);
  const auto f = [](double x) { return 3 - x + 7 * x * x * x - 2 * std::pow(x, 5); };
  const MatrixX coefficients = Interpolate(basis, f);
  MatrixX samples;
  basis.OnGrid(coefficients, &samples);
  ASSERT_EQ(basis.grid().size(), 21u);
  EXPECT_EQ(basis.grid().front(), 0);
  EXPECT_EQ(basis.grid().back(), 1);
  EXPECT_EQ(basis.node(0), 0);
  EXPECT_EQ(basis.node(5), 1);
  for (int k = 0; k <= 20; ++k) {
    EXPECT_NEAR(samples(0, k), f(basis.grid()[k]), 1e-14);
    EXPECT_NEAR(ChebyshevBasis::Evaluate(coefficients, 0, basis.grid()[k]), f(basis.grid()[k]), 1e-14);
  }
}

TEST(ChebyshevBasis, TailTellsTheErrorOfAnAnalyticFunction) {
  const auto f = [](double x) { return std::exp(2 * x) * std::sin(3 * x); };
  for (int degree : {4, 6, 8, 10, 12}) {
    const ChebyshevBasis basis(degree, 100);
    const MatrixX coefficients = Interpolate(basis, f);
    double error = 0;
    for (double x : basis.grid())
      error = std::max(error, std::abs(ChebyshevBasis::Evaluate(coefficients, 0, x) - f(x)));
    EXPECT_LT(error, ChebyshevBasis::Tail(coefficients, 0)) << degree;
    EXPECT_GT(error, 1e-4 * ChebyshevBasis::Tail(coefficients, 0)) << degree;
  }
}

// A peak that no node hits leaves a tail of its own size.
TEST(ChebyshevBasis, TailOfANarrowPeak) {
  const ChebyshevBasis basis(10, 48);
  EXPECT_GT(ChebyshevBasis::Tail(Interpolate(basis, [](double x) { return std::cos(40 * x); }), 0), 0.1);
}

}  // namespace
}  // namespace rollgait
