#include "core/math/collocation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

double Power(double t, int p) { return p == 0 ? 1 : std::pow(t, p); }

class SchemeTest : public ::testing::TestWithParam<Scheme> {
 protected:
  const Tableau tableau_ = TableauOf(GetParam());
};
class CollocationTest : public SchemeTest {};

// Σ b_j c_j^(k−1) = 1/k up to the order of the scheme, and not beyond.
TEST_P(SchemeTest, QuadratureHasItsOrder) {
  for (int k = 1; k <= tableau_.order + 1; ++k) {
    double sum = 0;
    for (int j = 0; j < tableau_.points(); ++j) sum += tableau_.b(j) * Power(tableau_.c(j), k - 1);
    if (k <= tableau_.order) {
      EXPECT_NEAR(sum, 1.0 / k, 1e-14) << k;
    } else {
      EXPECT_GT(std::abs(sum - 1.0 / k), 1e-6);
    }
  }
}

// Σ A_ij c_j^(k−1) = c_i^k / k for k ≤ s: what makes a Runge–Kutta scheme a collocation scheme. The last row of A is b.
TEST_P(CollocationTest, StagesIntegrateTheirPolynomials) {
  const int s = tableau_.points();
  for (int i = 0; i < s; ++i) {
    for (int k = 1; k <= s; ++k) {
      double sum = 0;
      for (int j = 0; j < s; ++j) sum += tableau_.A(i, j) * Power(tableau_.c(j), k - 1);
      EXPECT_NEAR(sum, Power(tableau_.c(i), k) / k, 1e-14);
    }
  }
  EXPECT_EQ(tableau_.c(s - 1), 1);
  EXPECT_TRUE(tableau_.A.row(s - 1).transpose().isApprox(tableau_.b, 1e-14));
  EXPECT_GT(tableau_.b.minCoeff(), 0);
}

// A motion with a polynomial acceleration is met exactly for any step: accelerations and velocities up to degree s − 1,
// positions inside the interval (two integrations of a polynomial of degree s − 1 through the points) up to degree s
// − 2.
TEST_P(CollocationTest, EliminationIsExactForPolynomials) {
  const EliminatedScheme scheme(tableau_);
  const int s = tableau_.points();
  ASSERT_EQ(scheme.sources(), s + 2);
  const double q0 = 0.4, v0 = -0.7;
  for (double h : {0.03, 0.5, 2.0}) {
    for (int degree = 0; degree < s; ++degree) {
      const auto a = [&](double t) { return 1.3 * Power(t, degree); };
      const auto v = [&](double t) { return v0 + 1.3 * Power(t, degree + 1) / (degree + 1); };
      const auto q = [&](double t) { return q0 + v0 * t + 1.3 * Power(t, degree + 2) / (degree + 1) / (degree + 2); };
      VectorX sources(s + 2);
      sources.head(4) << q(0), v(0), q(h), v(h);
      for (int j = 0; j < s - 2; ++j) sources(4 + j) = a(tableau_.c(j) * h);
      for (int i = 0; i < s; ++i) {
        double z[3] = {0, 0, 0};
        for (int source = 0; source < s + 2; ++source) {
          for (auto kind :
               {EliminatedScheme::kPosition, EliminatedScheme::kVelocity, EliminatedScheme::kAcceleration}) {
            z[kind] += scheme.Value(kind, i, source, h) * sources(source);
          }
        }
        const double t = tableau_.c(i) * h;
        // Accelerations are differences of positions divided by h², with coefficients of up to 200: rounding grows by
        // 1/h².
        const double rounding = 1e-12 * (1 + 1 / (h * h));
        if (degree <= s - 2 || i == s - 1) {
          EXPECT_NEAR(z[0], q(t), 1e-13 * (1 + std::abs(q(t))));
        }
        EXPECT_NEAR(z[1], v(t), rounding * (1 + std::abs(v(t))));
        EXPECT_NEAR(z[2], a(t), rounding * (1 + std::abs(a(t))));
      }
    }
  }
}

TEST_P(SchemeTest, DerivativesByTheStepMeetDifferences) {
  const EliminatedScheme scheme(tableau_);
  const double h = 0.3, step = 1e-5;
  int present = 0;
  for (auto kind : {EliminatedScheme::kPosition, EliminatedScheme::kVelocity, EliminatedScheme::kAcceleration}) {
    for (int i = 0; i < scheme.points(); ++i) {
      for (int source = 0; source < scheme.sources(); ++source) {
        const auto value = [&](double x) { return scheme.Value(kind, i, source, x); };
        const auto first = [&](double x) { return scheme.First(kind, i, source, x); };
        // Values reach 1e3, third derivatives 1e6: truncation 1e-10 · 1e6 is relative 1e-7 of the derivative.
        const double difference = (value(h + step) - value(h - step)) / (2 * step);
        EXPECT_NEAR(first(h), difference, 1e-7 * (1 + std::abs(difference)));
        const double second = (first(h + step) - first(h - step)) / (2 * step);
        EXPECT_NEAR(scheme.Second(kind, i, source, h), second, 1e-7 * (1 + std::abs(second)));
        EXPECT_EQ(scheme.Depends(kind, i, source), value(h) != 0);
        present += scheme.Depends(kind, i, source) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(present, 0);
}

INSTANTIATE_TEST_SUITE_P(Schemes, SchemeTest, ::testing::ValuesIn(EveryScheme()));
INSTANTIATE_TEST_SUITE_P(Schemes, CollocationTest, ::testing::ValuesIn(EveryCollocation()));

TEST(Collocation, TableauxOfTheBooks) {
  Eigen::Matrix2d radau;
  radau << 5.0 / 12, -1.0 / 12, 3.0 / 4, 1.0 / 4;
  EXPECT_TRUE(TableauOf(Scheme::kRadau2).A.isApprox(radau, 1e-14));
  Matrix3 lobatto;
  lobatto << 0, 0, 0, 5.0 / 24, 1.0 / 3, -1.0 / 24, 1.0 / 6, 2.0 / 3, 1.0 / 6;
  EXPECT_TRUE(TableauOf(Scheme::kHermiteSimpson).A.isApprox(lobatto, 1e-14));
  EXPECT_TRUE(TableauOf(Scheme::kHermiteSimpson).starts_at_node());
  EXPECT_FALSE(TableauOf(Scheme::kRadau3).starts_at_node());
  EXPECT_NEAR(TableauOf(Scheme::kRadau3).A(0, 0), (88 - 7 * std::sqrt(6.0)) / 360, 1e-14);
}

// v₁ = (4/3)((q₂ − q₀)/h − v₂/4): Radau-2 needs no acceleration among its unknowns.
TEST(Collocation, RadauTwoEliminatesAllAccelerations) {
  const EliminatedScheme scheme(TableauOf(Scheme::kRadau2));
  const double h = 0.2;
  ASSERT_EQ(scheme.sources(), 4);
  EXPECT_NEAR(scheme.Value(EliminatedScheme::kVelocity, 0, 0, h), -4.0 / 3 / h, 1e-13);
  EXPECT_NEAR(scheme.Value(EliminatedScheme::kVelocity, 0, 1, h), 0, 1e-13);
  EXPECT_NEAR(scheme.Value(EliminatedScheme::kVelocity, 0, 2, h), 4.0 / 3 / h, 1e-13);
  EXPECT_NEAR(scheme.Value(EliminatedScheme::kVelocity, 0, 3, h), -1.0 / 3, 1e-13);
}

TEST(Collocation, LagrangePolynomialsAreCardinalAndIntegrate) {
  const VectorX c = Vector3(0.1, 0.45, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(LagrangeValues(c, c(i)).isApprox(VectorX::Unit(3, i), 1e-12));
  }
  const double theta = 0.7, step = 1e-5;
  const VectorX first = (LagrangeIntegrals(c, theta + step) - LagrangeIntegrals(c, theta - step)) / (2 * step);
  const VectorX second =
      (LagrangeSecondIntegrals(c, theta + step) - LagrangeSecondIntegrals(c, theta - step)) / (2 * step);
  EXPECT_TRUE(first.isApprox(LagrangeValues(c, theta), 1e-8));
  EXPECT_TRUE(second.isApprox(LagrangeIntegrals(c, theta), 1e-8));
  EXPECT_TRUE(LagrangeSecondIntegrals(c, 0).isZero());
}

}  // namespace
}  // namespace rollgait
