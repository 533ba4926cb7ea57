#include "core/geometry/ellipsoid.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

constexpr int kCases = 100000;  // of every identity of contact-math 10

struct Sample {
  Ellipsoid ellipsoid;
  Vector3 nu, u, w;
};

std::vector<Sample> Samples(double smallest_ratio, int count) {
  SeededRandom random(20150911);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const double size = random.LogUniform(1e-3, 1e3);
    const double a = random.LogUniform(smallest_ratio, 1), b = random.LogUniform(smallest_ratio, 1);
    samples.push_back({Ellipsoid(size * Vector3(a, 1, b)), random.Unit(), random.Vector(-1, 1), random.Vector(-1, 1)});
  }
  return samples;
}

// Central difference of f along `direction`; f is evaluated off the unit sphere, where h stays homogeneous.
template <typename F>
auto Difference(const F& f, const Vector3& nu, const Vector3& direction, double step) {
  return ((f(nu + step * direction) - f(nu - step * direction)) / (2 * step)).eval();
}

// With semi-axis ratios within 5, third derivatives of S stay below a few hundred of its size, and a step of 1e-5 has
// an error of about 1e-10 · 500 / 6 + 1e-16 · 25 / 1e-5.
constexpr double kStep = 1e-5;
constexpr double kDifferenceTolerance = 2e-8;

TEST(EllipsoidTest, SupportPointLiesOnTheSurfaceWithTheGivenNormal) {
  for (const Sample& s : Samples(1e-3, kCases)) {
    const Vector3 x = s.ellipsoid.SupportPoint(s.nu);
    const Vector3 scaled = x.cwiseQuotient(s.ellipsoid.semi_axes());
    EXPECT_NEAR(scaled.squaredNorm(), 1, 8 * kEpsilon);
    const Vector3 gradient = scaled.cwiseQuotient(s.ellipsoid.semi_axes()).normalized();
    EXPECT_TRUE(MatrixNear(gradient, s.nu, 8 * kEpsilon));
    EXPECT_NEAR(s.nu.dot(x), s.ellipsoid.Support(s.nu), 8 * kEpsilon * x.norm());
  }
}

TEST(EllipsoidTest, SupportIsTheLargestProjectionOfTheSurface) {
  const Ellipsoid ellipsoid({0.135, 0.05, 0.068});
  SeededRandom random(7);
  const Vector3 nu = random.Unit();
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    largest = std::max(largest, nu.dot(ellipsoid.semi_axes().cwiseProduct(random.Unit())));
  }
  EXPECT_LE(largest, ellipsoid.Support(nu) * (1 + kEpsilon));
  // The nearest of 20000 points on the unit sphere is about 0.014 rad away, which costs half its square.
  EXPECT_NEAR(largest, ellipsoid.Support(nu), 1e-3 * ellipsoid.Support(nu));
}

TEST(EllipsoidTest, HessianIsSymmetricAnnihilatesTheNormalAndHasTheKnownProductOfRadii) {
  for (const Sample& s : Samples(1e-3, kCases)) {
    const Matrix3 hessian = s.ellipsoid.SupportHessian(s.nu);
    EXPECT_EQ(hessian, hessian.transpose());
    EXPECT_TRUE(MatrixNear(hessian * s.nu, Vector3::Zero(), 8 * kEpsilon * hessian.norm()));
    const double h = s.ellipsoid.Support(s.nu);
    // Sum of the principal minors = product of the two non-zero eigenvalues; it cancels by at most their ratio.
    const double product = hessian.topLeftCorner<2, 2>().determinant() +
                           hessian.bottomRightCorner<2, 2>().determinant() + hessian(0, 0) * hessian(2, 2) -
                           hessian(0, 2) * hessian(2, 0);
    const double expected = std::pow(s.ellipsoid.semi_axes().prod(), 2) / std::pow(h, 4);
    EXPECT_NEAR(product, expected, 16 * kEpsilon * hessian.squaredNorm() + 1e-13 * expected);
    EXPECT_GT(hessian.trace(), 0);
  }
}

TEST(EllipsoidTest, HigherDerivativesSatisfyTheIdentitiesOfHomogeneousFunctions) {
  for (const Sample& s : Samples(0.05, kCases)) {
    const Matrix3 hessian = s.ellipsoid.SupportHessian(s.nu);
    const Matrix3 third_u = s.ellipsoid.SupportThird(s.nu, s.u), third_w = s.ellipsoid.SupportThird(s.nu, s.w);
    const double size = 64 * kEpsilon;  // a handful of products and sums, each relative to its own size
    EXPECT_TRUE(MatrixNear(s.ellipsoid.SupportThird(s.nu, s.nu), -hessian, size * hessian.norm() * 20));
    EXPECT_TRUE(MatrixNear(third_u * s.w, third_w * s.u, size * third_u.norm() * 20));
    EXPECT_EQ(third_u, third_u.transpose());
    EXPECT_GT(third_u.norm(), 0);
    const Matrix3 fourth = s.ellipsoid.SupportFourth(s.nu, s.nu, s.u);
    EXPECT_TRUE(MatrixNear(fourth, -2 * third_u, size * (fourth.norm() + third_u.norm()) * 400));
    const Matrix3 swapped = s.ellipsoid.SupportFourth(s.nu, s.w, s.u);
    EXPECT_TRUE(MatrixNear(s.ellipsoid.SupportFourth(s.nu, s.u, s.w), swapped, size * swapped.norm() * 20));
  }
}

TEST(EllipsoidTest, EveryDerivativeIsThatOfTheOneBefore) {
  for (const Sample& s : Samples(0.2, 100)) {
    const Ellipsoid& e = s.ellipsoid;
    const double size = e.semi_axes().maxCoeff();
    const auto support = [&](const Vector3& nu) { return Eigen::Matrix<double, 1, 1>(e.Support(nu)); };
    const auto point = [&](const Vector3& nu) { return e.SupportPoint(nu); };
    const auto hessian = [&](const Vector3& nu) { return e.SupportHessian(nu); };
    const auto third = [&](const Vector3& nu) { return e.SupportThird(nu, s.w); };
    EXPECT_NEAR(Difference(support, s.nu, s.u, kStep)(0), e.SupportPoint(s.nu).dot(s.u), kDifferenceTolerance * size);
    EXPECT_TRUE(
        MatrixNear(Difference(point, s.nu, s.u, kStep), e.SupportHessian(s.nu) * s.u, kDifferenceTolerance * size));
    const Matrix3 third_u = e.SupportThird(s.nu, s.u);
    EXPECT_TRUE(MatrixNear(Difference(hessian, s.nu, s.u, kStep), third_u, 10 * kDifferenceTolerance * size));
    EXPECT_TRUE(MatrixNear(Difference(third, s.nu, s.u, kStep), e.SupportFourth(s.nu, s.u, s.w),
                           100 * kDifferenceTolerance * size));
    EXPECT_GT(third_u.norm(), 1e-3 * size);
  }
}

TEST(EllipsoidTest, SphereHasConstantCurvature) {
  const double radius = 0.27;
  const Ellipsoid sphere(Vector3::Constant(radius));
  const Vector3 nu = SeededRandom(3).Unit();
  EXPECT_NEAR(sphere.Support(nu), radius, 4 * kEpsilon);
  EXPECT_TRUE(MatrixNear(sphere.SupportPoint(nu), radius * nu, 4 * kEpsilon));
  EXPECT_TRUE(
      MatrixNear(sphere.SupportHessian(nu), radius * (Matrix3::Identity() - nu * nu.transpose()), 4 * kEpsilon));
}

// Sole of the default foot: radii of curvature a²/c and b²/c at the lowest point.
TEST(EllipsoidTest, RadiiOfCurvatureAtTheEndOfAnAxis) {
  const Ellipsoid foot({0.135, 0.05, 0.068});
  const Matrix3 hessian = foot.SupportHessian(-Vector3::UnitZ());
  EXPECT_NEAR(hessian(0, 0), 0.135 * 0.135 / 0.068, 1e-15);
  EXPECT_NEAR(hessian(1, 1), 0.05 * 0.05 / 0.068, 1e-15);
  EXPECT_EQ(hessian(2, 2), 0);
}

TEST(EllipsoidTest, ExtremeSizesNeitherOverflowNorUnderflow) {
  const Ellipsoid reference({0.5, 0.25, 1});
  const Vector3 nu = SeededRandom(11).Unit();
  for (const double size : {std::ldexp(1.0, 700), std::ldexp(1.0, -700)}) {  // powers of two: no rounding
    const Ellipsoid scaled(size * reference.semi_axes());
    EXPECT_EQ(scaled.Support(nu) / size, reference.Support(nu));
    EXPECT_EQ(scaled.SupportPoint(nu) / size, reference.SupportPoint(nu));
    EXPECT_EQ(scaled.SupportHessian(nu) / size, reference.SupportHessian(nu));
    EXPECT_EQ(scaled.SupportThird(nu, nu) / size, reference.SupportThird(nu, nu));
  }
}

TEST(EllipsoidDeathTest, SemiAxesMustBePositiveAndFinite) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(Ellipsoid(Vector3(0.1, 0, 0.1)), "contract");
  EXPECT_DEATH(Ellipsoid(Vector3(0.1, -0.1, 0.1)), "contract");
  EXPECT_DEATH(Ellipsoid(Vector3(0.1, 0.1, kInfinity)), "contract");
  EXPECT_DEATH(Ellipsoid(Vector3(0.1, 0.1, std::numeric_limits<double>::quiet_NaN())), "contract");
}

}  // namespace
}  // namespace rollgait
