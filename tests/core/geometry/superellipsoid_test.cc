#include "core/geometry/superellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/surface.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

SupportJet Jet(const Superellipsoid& body, const Vector3& nu) {
  SupportJet jet;
  body.Evaluate(nu, 4, &jet);
  return jet;
}

TEST(SuperellipsoidTest, RefusesWhatItCannotCompute) {
  const Result<Superellipsoid> bad = Superellipsoid::Create({0.1, -0.2, 0.3}, 0.01, 2, "surface.superellipsoid");
  ASSERT_FALSE(bad.ok());
  ASSERT_EQ(bad.violations().size(), 3u);
  EXPECT_EQ(bad.violations()[0].field, "surface.superellipsoid.semi_axes_m");
  EXPECT_NE(bad.violations()[0].message.find("-0.2"), std::string::npos);
  EXPECT_EQ(bad.violations()[1].field, "surface.superellipsoid.exponent_1");
  EXPECT_NE(bad.violations()[1].message.find("0.05"), std::string::npos);
  EXPECT_EQ(bad.violations()[2].field, "surface.superellipsoid.exponent_2");
  EXPECT_FALSE(Superellipsoid::Create({0.1, 0.2, kInfinity}, 1, 1).ok());
  EXPECT_FALSE(Superellipsoid::Create({0.1, 0.2, 0.3}, std::nan(""), 1).ok());
  EXPECT_TRUE(Superellipsoid::Create({0.1, 0.2, 0.3}, 0.05, 1.95).ok());
}

// Exponents 1: the ellipsoid, by independent formulas; on coordinate planes and poles, too.
TEST(SuperellipsoidTest, WithExponentsOneItIsTheEllipsoidEverywhere) {
  SeededRandom random(5);
  const Vector3 axes(0.3, 1.7, 0.6);
  const Superellipsoid body(axes, 1, 1);
  const Ellipsoid ellipsoid(axes);
  for (int i = 0; i < 500; ++i) {
    Vector3 nu = random.Unit();
    if (i % 4 == 1) nu[i / 4 % 3] = 0;
    if (i % 4 == 2) nu = Vector3::Unit(i / 4 % 3);
    if (i % 4 == 3) nu[i / 4 % 3] = 1e-160;
    nu.normalize();
    const Vector3 u = random.Unit(), w = random.Unit();
    const SupportJet jet = Jet(body, nu);
    ASSERT_EQ(jet.order, 4) << nu.transpose();
    EXPECT_TRUE(MatrixNear(jet.x, ellipsoid.SupportPoint(nu), 16 * kEpsilon));
    const Matrix3 S = ellipsoid.SupportHessian(nu), T = ellipsoid.SupportThird(nu, u);
    const Matrix3 Q = ellipsoid.SupportFourth(nu, u, w);
    EXPECT_TRUE(MatrixNear(jet.S, S, 256 * kEpsilon * S.norm()));
    EXPECT_TRUE(MatrixNear(jet.Third(u), T, 4096 * kEpsilon * (S.norm() + T.norm())));
    EXPECT_TRUE(MatrixNear(jet.Fourth(u, w), Q, 65536 * kEpsilon * (S.norm() + T.norm() + Q.norm())));
  }
}

// What exists where a component of ν is exactly zero: the table of the header.
TEST(SuperellipsoidTest, OrderOfDerivativesAtFlatsEdgesAndPoles) {
  const Vector3 axes(0.3, 0.4, 0.5), equator = Vector3(3, 4, 0) / 5, around = Vector3(0, 3, 4) / 5;
  struct Row {
    double exponent_1, exponent_2;
    int equator, around, pole;
  };
  for (const Row& row : {Row{0.5, 0.5, 1, 1, 1}, Row{1, 1, 4, 4, 4}, Row{1.2, 1.2, 2, 2, 2}, Row{1.4, 1.4, 3, 3, 3},
                         Row{1.5, 1.5, 4, 4, 4}, Row{1.7, 1.7, 4, 4, 4}, Row{0.5, 1, 1, 4, 1}, Row{1, 0.5, 4, 1, 1},
                         Row{1.5, 1, 4, 4, 4}, Row{1.2, 1.5, 2, 4, 2}}) {
    const Superellipsoid body(axes, row.exponent_1, row.exponent_2);
    const auto name = ::testing::Message() << row.exponent_1 << " " << row.exponent_2;
    EXPECT_EQ(Jet(body, equator).order, row.equator) << name;
    EXPECT_EQ(Jet(body, around).order, row.around) << name;
    EXPECT_EQ(Jet(body, Vector3::UnitZ()).order, row.pole) << name;
    for (const Vector3& nu : {Vector3(equator), Vector3(around), Vector3(Vector3::UnitZ())}) {
      const SupportJet jet = Jet(body, nu);
      EXPECT_TRUE(jet.x.allFinite());
      EXPECT_EQ(jet.S(0, 0) == kInfinity && jet.S(1, 2) == kInfinity, jet.order < 2) << name;
      EXPECT_EQ(jet.T[2](0, 1) == kInfinity, jet.order < 3) << name;
      EXPECT_EQ(jet.Q[5](0, 1) == kInfinity, jet.order < 4) << name;
      const Surface surface = body;
      EXPECT_EQ(surface.RollingVelocity(nu, {1, 2, 3}).x() == kInfinity, jet.order < 2);
      EXPECT_EQ(surface.SupportThird(nu, {0, 0, 0})(0, 0) == kInfinity, jet.order < 3);
    }
  }
}

// Down to the smallest numbers: everything is finite with the right order, or infinite and said to be so; never NaN.
TEST(SuperellipsoidTest, NeverNotANumber) {
  SeededRandom random(6);
  int infinite = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 axes(1, random.LogUniform(1e-3, 1), random.LogUniform(1e-3, 1));
    const Superellipsoid body(random.LogUniform(1e-3, 1e3) * axes, random.Uniform(0.05, 1.95),
                              random.Uniform(0.05, 1.95));
    Vector3 nu = random.Unit();
    for (int k = 0; k < 3; ++k) {
      if (random.Uniform(0, 1) < 0.3) nu[k] = random.Uniform(0, 1) < 0.3 ? 0 : random.LogUniform(1e-300, 1);
    }
    if (nu.isZero(0)) continue;
    nu.normalize();
    const SupportJet jet = Jet(body, nu);
    ASSERT_GE(jet.order, 1);
    ASSERT_TRUE(jet.x.allFinite() && std::isfinite(jet.h)) << nu.transpose();
    ASSERT_FALSE(jet.S.hasNaN() || jet.T[0].hasNaN() || jet.T[1].hasNaN() || jet.T[2].hasNaN());
    for (const Matrix3& q : jet.Q) ASSERT_FALSE(q.hasNaN());
    ASSERT_EQ(jet.S.allFinite(), jet.order >= 2);
    EXPECT_LE(jet.x.cwiseQuotient(body.semi_axes()).cwiseAbs().maxCoeff(), 1 + 64 * kEpsilon);
    infinite += jet.order < 4;
  }
  EXPECT_GT(infinite, 1000);
}

}  // namespace
}  // namespace rollgait
