#include "core/geometry/smooth_superellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/superellipsoid.h"
#include "core/geometry/surface.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

TEST(SmoothSuperellipsoidTest, RefusesWhatItCannotCompute) {
  const auto bad = SmoothSuperellipsoid::Create({0.1, -0.2, 0.3}, 0.01, 2, 1.5, "surface.superellipsoid");
  ASSERT_FALSE(bad.ok());
  ASSERT_EQ(bad.violations().size(), 4u);
  EXPECT_EQ(bad.violations()[0].field, "surface.superellipsoid.semi_axes_m");
  EXPECT_EQ(bad.violations()[1].field, "surface.superellipsoid.exponent_1");
  EXPECT_EQ(bad.violations()[2].field, "surface.superellipsoid.exponent_2");
  EXPECT_EQ(bad.violations()[3].field, "surface.superellipsoid.smoothing");
  EXPECT_EQ(bad.violations()[3].message, "The smoothing is 1.5; it must lie in 0.01 … 1.");
  EXPECT_FALSE(SmoothSuperellipsoid::Create({0.1, 0.2, 0.3}, 1, 1, std::nan("")).ok());
  EXPECT_TRUE(SmoothSuperellipsoid::Create({0.1, 0.2, 0.3}, 0.05, 1.95, 0.01).ok());
}

// Exponents 1: the ellipsoid, by its own formulas, whatever the smoothing; on coordinate planes and poles, too.
TEST(SmoothSuperellipsoidTest, WithExponentsOneItIsTheEllipsoidEverywhere) {
  SeededRandom random(5);
  const Vector3 axes(0.3, 1.7, 0.6);
  const Ellipsoid ellipsoid(axes);
  for (int i = 0; i < 300; ++i) {
    const SmoothSuperellipsoid body(axes, 1, 1, random.LogUniform(0.01, 1));
    Vector3 nu = random.Unit();
    if (i % 3 == 1) nu[i / 3 % 3] = 0;
    if (i % 3 == 2) nu = Vector3::Unit(i / 3 % 3);
    nu.normalize();
    const Vector3 u = random.Unit(), w = random.Unit();
    SupportJet jet;
    body.Evaluate(nu, 4, &jet);
    ASSERT_EQ(jet.order, 4);
    EXPECT_TRUE(MatrixNear(body.SupportPoint(nu), ellipsoid.SupportPoint(nu), 16 * kEpsilon));
    const Matrix3 S = ellipsoid.SupportHessian(nu), T = ellipsoid.SupportThird(nu, u);
    const Matrix3 Q = ellipsoid.SupportFourth(nu, u, w);
    EXPECT_TRUE(MatrixNear(jet.S, S, 256 * kEpsilon * S.norm()));
    EXPECT_TRUE(MatrixNear(jet.Third(u), T, 4096 * kEpsilon * (S.norm() + T.norm())));
    EXPECT_TRUE(MatrixNear(jet.Fourth(u, w), Q, 65536 * kEpsilon * (S.norm() + T.norm() + Q.norm())));
  }
}

// Where the superellipsoid is flat, has an edge or no third derivative: a curvature of the size that the header states,
// and the semi-axes of the request.
TEST(SmoothSuperellipsoidTest, HasItsSemiAxesAndACurvatureAtTheirEnds) {
  const Vector3 axes(0.06, 0.05, 0.02);
  for (const double exponent : {0.6, 0.8, 1.0, 1.2, 1.6}) {
    const double sigma = 0.1, q = 2 / (2 - exponent);
    const SmoothSuperellipsoid body(axes, exponent, exponent, sigma);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(body.Support(Vector3::Unit(i)), axes[i], 4 * kEpsilon) << exponent;
      EXPECT_TRUE(MatrixNear(body.SupportPoint(-Vector3::Unit(i)), -axes[i] * Vector3::Unit(i), 4 * kEpsilon));
    }
    const double radius = body.SupportHessian(-Vector3::UnitZ())(0, 0), square = sigma * sigma;
    const double share = (std::pow(sigma, q - 2) * (1 + 2 * square) + square * std::pow(1 + square, q / 2 - 1)) /
                         (2 * std::pow(sigma, q) + std::pow(1 + square, q / 2));
    EXPECT_NEAR(radius, share * axes.x() * axes.x() / axes.z(), 1e-14) << exponent;
    EXPECT_EQ(share > 1 + 1e-12, exponent < 1) << exponent;
  }
}

TEST(SmoothSuperellipsoidTest, ApproachesTheSuperellipsoid) {
  SeededRandom random(7);
  const Vector3 axes(0.06, 0.05, 0.02);
  double before = kInfinity;
  for (const double sigma : {0.1, 0.03, 0.01}) {
    double largest = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3 nu = random.Unit();
      for (const auto& [e_1, e_2] : {std::pair(0.6, 0.6), {1.6, 1.6}, {0.7, 1.3}}) {
        const double sharp = Superellipsoid(axes, e_1, e_2).Support(nu);
        largest = std::max(largest, std::abs(SmoothSuperellipsoid(axes, e_1, e_2, sigma).Support(nu) / sharp - 1));
      }
    }
    EXPECT_LT(largest, before / 3);
    before = largest;
  }
  EXPECT_LT(before, 0.005);
  EXPECT_GT(before, 1e-6);
}

TEST(SurfaceTest, SemiAxesAreThoseOfBodiesThatWalk) {
  const Vector3 axes(0.3, 0.2, 0.1);
  const Surface smooth = SmoothSuperellipsoid(axes, 0.8, 0.8, 0.1);
  ASSERT_NE(smooth.semi_axes(), nullptr);
  EXPECT_EQ(*smooth.semi_axes(), axes);
  EXPECT_EQ(*Surface(Ellipsoid(axes)).semi_axes(), axes);
  EXPECT_EQ(smooth.Rounded(0.1).semi_axes(), nullptr);
  EXPECT_EQ(smooth.MovedTo(Vector3::UnitX()).semi_axes(), nullptr);
  EXPECT_EQ(Surface(Superellipsoid(axes, 0.8, 0.8)).semi_axes(), nullptr);
  EXPECT_EQ(Surface(Sphere(1)).semi_axes(), nullptr);
}

TEST(SupportDifferenceTest, IsZeroForTheSameShapeAlone) {
  const Vector3 axes(0.3, 0.2, 0.1);
  const Matrix3 none = Matrix3::Identity(), mirror = Vector3(1, -1, 1).asDiagonal();
  Matrix3 swap = Matrix3::Zero();  // a quarter turn about z
  swap(0, 1) = -1, swap(1, 0) = 1, swap(2, 2) = 1;
  const Surface boxy = SmoothSuperellipsoid(axes, 0.8, 0.8, 0.1), other = SmoothSuperellipsoid(axes, 0.8, 0.9, 0.1);
  EXPECT_EQ(SupportDifference(boxy, none, boxy, none), 0);
  EXPECT_EQ(SupportDifference(boxy, none, boxy, mirror), 0);
  EXPECT_GT(SupportDifference(boxy, none, other, none), 1e-4);
  EXPECT_GT(SupportDifference(boxy, none, Ellipsoid(axes), none), 1e-3);
  EXPECT_GT(SupportDifference(boxy, none, boxy, swap), 0.01);
  EXPECT_GT(SupportDifference(boxy, none, boxy.MovedTo(Vector3(1e-3, 0, 0)), none), 9e-4);
}

}  // namespace
}  // namespace rollgait
