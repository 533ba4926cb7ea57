#include "core/geometry/implicit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "core/geometry/flattened_superellipsoid.h"
#include "core/geometry/superellipsoid.h"
#include "core/geometry/surface.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// f(|x/a|²) for any growing f with its first two derivatives: an ellipsoid written in an awkward way.
class Rescaled : public ConvexFunction {
 public:
  Rescaled(const Vector3& axes, std::function<Vector3(double)> f) : axes_(axes), f_(std::move(f)) {}
  double Value(const Vector3& x) const override { return F(x)[0]; }
  Vector3 Gradient(const Vector3& x) const override { return F(x)[1] * S(x); }
  Matrix3 Hessian(const Vector3& x) const override {
    const Vector3 s = S(x);
    Matrix3 hessian = F(x)[2] * s * s.transpose();
    hessian.diagonal() += 2 * F(x)[1] * axes_.cwiseAbs2().cwiseInverse();
    return hessian;
  }
  Matrix3 Third(const Vector3&, const Vector3&) const override { return Matrix3::Zero(); }
  Matrix3 Fourth(const Vector3&, const Vector3&, const Vector3&) const override { return Matrix3::Zero(); }
  int derivatives() const override { return 2; }

 private:
  Vector3 F(const Vector3& x) const { return f_(x.cwiseQuotient(axes_).squaredNorm()); }
  Vector3 S(const Vector3& x) const { return 2 * x.cwiseQuotient(axes_.cwiseAbs2()); }
  Vector3 axes_;
  std::function<Vector3(double)> f_;
};

Result<ImplicitSurface> Create(const Vector3& axes, std::function<Vector3(double)> f) {
  return ImplicitSurface::Create(std::make_shared<Rescaled>(axes, std::move(f)), "surface.implicit");
}

TEST(ImplicitSurfaceTest, SaysWhatIsWrongWithAFunction) {
  const Vector3 axes(0.3, 0.2, 0.1);
  const auto expect = [](const Result<ImplicitSurface>& result, const std::string& text) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.violations()[0].field, "surface.implicit");
    EXPECT_NE(result.violations()[0].message.find(text), std::string::npos) << result.violations()[0].message;
  };
  expect(ImplicitSurface::Create(nullptr, "surface.implicit"), "no function");
  expect(Create(axes, [](double s) { return Vector3(s, 1, 0); }), "at the origin");
  expect(Create(axes, [](double s) { return Vector3(-1 - s, -1, 0); }), "no zero between");
  expect(Create(axes, [](double s) { return Vector3(s - 1, 2, 0); }), "differs from differences");
  // √s: convex along rays, but written with a negative second derivative it is not.
  expect(Create(axes, [](double s) { return Vector3(std::log(s + 0.1), 1 / (s + 0.1), -1 / ((s + 0.1) * (s + 0.1))); }),
         "must be convex");
  EXPECT_TRUE(Create(axes, [](double s) { return Vector3(s - 1, 1, 0); }).ok());
}

// exp(20 s) and s⁸ grow by orders of magnitude over the body: Newton's method alone does not converge from everywhere.
TEST(ImplicitSurfaceTest, ConvergesForEveryConvexFunction) {
  SeededRandom random(17);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 ratios(random.LogUniform(0.01, 1), 1, random.LogUniform(0.01, 1));
    const Vector3 axes = random.LogUniform(1e-3, 1e3) * ratios;
    const Ellipsoid ellipsoid(axes);
    const std::function<Vector3(double)> functions[] = {
        [](double s) { return Vector3(s - 1, 1, 0); },
        [](double s) { return Vector3(std::exp(20 * s) * Vector3(1, 20, 400) - std::exp(20.0) * Vector3::UnitX()); },
        [](double s) { return Vector3(std::pow(s, 8) - 1, 8 * std::pow(s, 7), 56 * std::pow(s, 6)); }};
    const Result<ImplicitSurface> created = Create(axes, functions[i % 3]);
    ASSERT_TRUE(created.ok()) << created.violations()[0].message;
    const Vector3 nu = random.Unit();
    SupportJet jet;
    created.value().Evaluate(nu, 4, &jet);
    EXPECT_EQ(jet.order, 2);  // this function has no third derivative
    EXPECT_EQ(jet.T[0](0, 0), kInfinity);
    const Matrix3 S = ellipsoid.SupportHessian(nu);
    EXPECT_TRUE(MatrixNear(jet.x, ellipsoid.SupportPoint(nu), 1e-11 * (axes.maxCoeff() + S.norm()))) << i;
    EXPECT_TRUE(MatrixNear(jet.S, S, 1e-8 * S.norm())) << i;
    ++checked;
  }
  EXPECT_EQ(checked, 300);
}

TEST(FlattenedSuperellipsoidTest, RefusesPinchedBodiesAndOddFlattenings) {
  const Result<ImplicitSurface> pinched = FlattenedSuperellipsoid::Create({1, 1, 1}, 0.5, 1.2, 0.1, "s");
  ASSERT_FALSE(pinched.ok());
  EXPECT_EQ(pinched.violations()[0].field, "s.exponent_2");
  const Result<ImplicitSurface> sharp = FlattenedSuperellipsoid::Create({1, 1, 1}, 0.5, 0.5, 1e-9, "s");
  ASSERT_FALSE(sharp.ok());
  EXPECT_EQ(sharp.violations()[0].field, "s.flattening");
  EXPECT_FALSE(FlattenedSuperellipsoid::Create({1, 0, 1}, 0.5, 0.5, 0.1).ok());
}

// On a face, where the superellipsoid is flat: the radius of curvature that the header promises.
TEST(FlattenedSuperellipsoidTest, FacesHaveTheStatedCurvature) {
  const Vector3 axes(0.3, 0.4, 0.5);
  for (const double exponent : {0.5, 0.25}) {
    for (const double delta : {0.01, 0.3}) {
      const ImplicitSurface body = FlattenedSuperellipsoid::Create(axes, exponent, exponent, delta).value();
      SupportJet jet;
      body.Evaluate(Vector3::UnitZ(), 2, &jet);
      ASSERT_EQ(jet.order, 2);
      EXPECT_NEAR(jet.x.z(), axes.z(), 16 * kEpsilon);
      for (int i = 0; i < 2; ++i) {
        const double radius = axes[i] * axes[i] * (1 / exponent + delta) / (delta * axes.z());
        EXPECT_NEAR(jet.S(i, i), radius, 1e-12 * radius);
      }
      SupportJet flat;
      Superellipsoid(axes, exponent, exponent).Evaluate(Vector3::UnitZ(), 2, &flat);
      EXPECT_EQ(flat.order, 1);
    }
  }
}

// As δ → 0 the body becomes the superellipsoid.
TEST(FlattenedSuperellipsoidTest, ApproachesTheSuperellipsoid) {
  SeededRandom random(23);
  const Vector3 axes(0.3, 0.4, 0.5);
  for (int i = 0; i < 50; ++i) {
    const Vector3 nu = random.Unit();
    double last = kInfinity;
    for (const double delta : {1e-2, 1e-4, 1e-6}) {
      const ImplicitSurface body = FlattenedSuperellipsoid::Create(axes, 0.4, 0.6, delta).value();
      const double error = std::abs(body.Support(nu) - Superellipsoid(axes, 0.4, 0.6).Support(nu));
      EXPECT_LE(error, delta);
      EXPECT_LE(error, last);
      last = error;
    }
  }
}

}  // namespace
}  // namespace rollgait
