// The explicit methods of Runge and Kutta behind direct multiple shooting.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/math/collocation.h"
#include "core/math/scheme.h"

namespace rollgait {
namespace {

class ExplicitSchemeTest : public ::testing::TestWithParam<Scheme> {
 protected:
  const Tableau tableau_ = TableauOf(GetParam());
};

// Butcher's conditions for order 4, and the first one of order 5, which such a method of four stages cannot meet.
TEST_P(ExplicitSchemeTest, MeetsTheConditionsOfOrderFour) {
  const MatrixX& A = tableau_.A;
  const VectorX &b = tableau_.b, &c = tableau_.c, squares = c.cwiseAbs2();
  EXPECT_EQ(tableau_.order, 4);
  EXPECT_TRUE(tableau_.is_explicit);
  EXPECT_EQ(A.triangularView<Eigen::Upper>().toDenseMatrix().cwiseAbs().maxCoeff(), 0);
  EXPECT_LT((A.rowwise().sum() - c).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(b.sum(), 1, 1e-15);
  EXPECT_NEAR(b.dot(c), 1.0 / 2, 1e-15);
  EXPECT_NEAR(b.dot(squares), 1.0 / 3, 1e-15);
  EXPECT_NEAR(b.dot(A * c), 1.0 / 6, 1e-15);
  EXPECT_NEAR(b.dot(squares.cwiseProduct(c)), 1.0 / 4, 1e-15);
  EXPECT_NEAR(b.cwiseProduct(c).dot(A * c), 1.0 / 8, 1e-15);
  EXPECT_NEAR(b.dot(A * squares), 1.0 / 12, 1e-15);
  EXPECT_NEAR(b.dot(A * A * c), 1.0 / 24, 1e-15);
  EXPECT_GT(std::abs(b.dot(squares.cwiseAbs2()) - 1.0 / 5), 1e-3);
}

// With any accelerations at the stages the states of all stages are those that the method makes one after the other.
TEST_P(ExplicitSchemeTest, EliminationTakesTheStagesOneAfterTheOther) {
  const EliminatedScheme scheme(tableau_);
  const int s = tableau_.points();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double h : {0.02, 0.4}) {
    VectorX a(s), v(s), q(s);
    for (double& value : a) value = uniform(random);
    double v_end = uniform(random), q_end = uniform(random);
    const double v0 = v_end, q0 = q_end;
    for (int i = 0; i < s; ++i) {
      v(i) = v0, q(i) = q0;
      for (int j = 0; j < i; ++j) {
        v(i) += h * tableau_.A(i, j) * a(j);
        q(i) += h * tableau_.A(i, j) * v(j);
      }
      v_end += h * tableau_.b(i) * a(i);
      q_end += h * tableau_.b(i) * v(i);
    }
    VectorX sources(scheme.sources());
    sources << q0, v0, q_end, v_end, a.head(s - 2);
    const VectorX expected[] = {q, v, a};
    for (const auto kind : EliminatedScheme::kKinds) {
      for (int i = 0; i < s; ++i) {
        double value = 0;
        for (int source = 0; source < scheme.sources(); ++source) {
          value += scheme.Value(kind, i, source, h) * sources(source);
        }
        EXPECT_NEAR(value, expected[kind](i), 1e-13 / (h * h)) << kind << " " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ExplicitSchemeTest,
                         ::testing::Values(Scheme::kShootingConstant, Scheme::kShootingLinear));

}  // namespace
}  // namespace rollgait
