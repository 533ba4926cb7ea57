#include "core/math/bernstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/math/collocation.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

// By de Casteljau's algorithm.
double Evaluate(VectorX b, double theta) {
  for (Eigen::Index left = b.size() - 1; left > 0; --left) {
    for (Eigen::Index i = 0; i < left; ++i) b(i) = (1 - theta) * b(i) + theta * b(i + 1);
  }
  return b(0);
}

TEST(Bernstein, MonomialsKeepTheirPolynomial) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int degree = 0; degree <= 5; ++degree) {
    VectorX m(degree + 1);
    for (double& value : m) value = uniform(random);
    const VectorX b = BernsteinFromMonomials(degree) * m;
    for (double theta = 0; theta <= 1; theta += 0.125) {
      double sum = 0;
      for (int k = 0; k <= degree; ++k) sum += m(k) * std::pow(theta, k);
      EXPECT_NEAR(Evaluate(b, theta), sum, 1e-14 * (degree + 1));
      EXPECT_LE(sum, b.maxCoeff() + 1e-14);
      EXPECT_GE(sum, b.minCoeff() - 1e-14);
    }
  }
}

TEST(Bernstein, ValuesAtThePointsOfEveryScheme) {
  for (const Scheme scheme : EveryScheme()) {
    const Tableau tableau = TableauOf(scheme);
    VectorX values(tableau.points());
    for (int i = 0; i < values.size(); ++i) values(i) = std::sin(3 * tableau.c(i)) + 0.1;
    const MatrixX m = BernsteinFromValues(tableau.c);
    const VectorX b = m * values;
    for (int i = 0; i < values.size(); ++i) EXPECT_NEAR(Evaluate(b, tableau.c(i)), values(i), 1e-13);
    // A coefficient at a point is the value there, to the bit: it takes a bound in place of a row.
    EXPECT_EQ(m(values.size() - 1, values.size() - 1), 1);
    EXPECT_EQ(m.row(values.size() - 1).cwiseAbs().sum(), 1);
    EXPECT_EQ(m.row(0).cwiseAbs().sum() == 1, tableau.starts_at_node());
  }
}

}  // namespace
}  // namespace rollgait
