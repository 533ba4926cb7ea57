// What every kind of surface promises, whatever it is: see core/geometry/surface.h.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/conformance/surface_cases.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// Rounding of identities: sums of tens of terms; implicit surfaces add the residual of Newton's method.
constexpr double kRounding = 4096 * kEpsilon;
constexpr int kNormals = 60;

class SurfaceConformance : public ::testing::TestWithParam<SurfaceCase> {
 protected:
  Vector3 Normal() {
    for (;;) {
      const Vector3 nu = random_.Unit();
      if (nu.cwiseAbs().minCoeff() >= GetParam().least_component) return nu;
    }
  }
  SupportJet Jet(const Vector3& nu) const {
    SupportJet jet;
    surface_.Evaluate(nu, 4, &jet);
    return jet;
  }
  double Size() const { return surface_.Size(); }

  SeededRandom random_{20260611};
  const Surface surface_ = GetParam().make(1);
};

TEST_P(SurfaceConformance, MembersAgreeWithTheJet) {
  for (int n = 0; n < kNormals; ++n) {
    const Vector3 nu = Normal(), u = random_.Unit(), w = random_.Unit();
    const SupportJet jet = Jet(nu);
    ASSERT_EQ(jet.order, 4);
    EXPECT_NEAR(surface_.Support(nu), jet.h, kRounding * Size());
    EXPECT_TRUE(MatrixNear(surface_.SupportPoint(nu), jet.x, kRounding * Size()));
    EXPECT_TRUE(MatrixNear(surface_.SupportHessian(nu), jet.S, kRounding * jet.S.norm()));
    const Matrix3 third = jet.Third(u), fourth = jet.Fourth(u, w);
    EXPECT_TRUE(MatrixNear(surface_.SupportThird(nu, u), third, kRounding * (third.norm() + jet.S.norm())));
    EXPECT_TRUE(MatrixNear(surface_.SupportFourth(nu, u, w), fourth, kRounding * (fourth.norm() + jet.S.norm())));
    EXPECT_TRUE(MatrixNear(surface_.RollingVelocity(nu, u), jet.S * nu.cross(u), kRounding * jet.S.norm()));
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = nu.cross(u).normalized();
    tangents.col(1) = nu.cross(Vector3(tangents.col(0)));
    EXPECT_TRUE(MatrixNear(surface_.TangentHessian(nu, tangents), tangents.transpose() * jet.S * tangents,
                           kRounding * jet.S.norm()));
  }
}

TEST_P(SurfaceConformance, TheSupportPointIsTheFurthestOfTheSurface) {
  const auto& equation = GetParam().equation;
  for (int n = 0; n < 10; ++n) {
    const Vector3 nu = Normal();
    const double h = surface_.Support(nu);
    // Against the body's own points: none reaches further.
    for (int i = 0; i < 200; ++i) EXPECT_LE(nu.dot(surface_.SupportPoint(Normal())), h + kRounding * Size());
    if (!equation) continue;
    EXPECT_NEAR(equation(surface_.SupportPoint(nu)), 0, 100 * kRounding);
    // Against the equation: climb along the surface from random points, with steps that shrink.
    const Vector3 inside = surface_.SupportPoint(nu) + surface_.SupportPoint(-nu);
    const auto on_surface = [&](const Vector3& direction) -> Vector3 {
      double low = 0, high = 8;
      for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (equation(inside / 2 + middle * direction) < 0 ? low : high) = middle;
      }
      return inside / 2 + low * direction;
    };
    Vector3 best_direction = nu;
    double best = nu.dot(on_surface(nu));
    for (double radius = 1; radius > 1e-5; radius *= 0.97) {
      const Vector3 direction = (best_direction + radius * random_.Unit()).normalized();
      const double reach = nu.dot(on_surface(direction));
      if (reach > best) best = reach, best_direction = direction;
    }
    EXPECT_LE(best, h + kRounding * Size());
    EXPECT_NEAR(best, h, 1e-3 * Size());
  }
}

TEST_P(SurfaceConformance, IdentitiesOfHomogeneousFunctions) {
  for (int n = 0; n < kNormals; ++n) {
    const Vector3 nu = Normal(), u = random_.Unit(), w = random_.Unit();
    const SupportJet jet = Jet(nu);
    ASSERT_EQ(jet.order, 4);
    const double S = jet.S.norm();
    const Matrix3 third_u = jet.Third(u), third_w = jet.Third(w);
    const double T = jet.T[0].norm() + jet.T[1].norm() + jet.T[2].norm();
    double Q = 0;
    for (const Matrix3& q : jet.Q) Q += q.norm();
    EXPECT_NEAR(nu.dot(jet.x), jet.h, kRounding * Size());
    EXPECT_TRUE(MatrixNear(jet.S * nu, Vector3::Zero(), kRounding * S));
    EXPECT_EQ(jet.S, jet.S.transpose());
    EXPECT_TRUE(MatrixNear(jet.Third(nu), -jet.S, kRounding * (T + S)));
    EXPECT_TRUE(MatrixNear(third_u * w, third_w * u, kRounding * T));
    EXPECT_TRUE(MatrixNear(jet.Fourth(nu, u), -2 * third_u, kRounding * (Q + T)));
    EXPECT_TRUE(MatrixNear(jet.Fourth(u, w), jet.Fourth(w, u), kRounding * Q));
    EXPECT_TRUE(MatrixNear(jet.Fourth(u, w) * nu, -2 * third_u * w, kRounding * (Q + T)));
    const Vector3 eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix3>(jet.S).eigenvalues();
    EXPECT_GE(eigenvalues[0], -kRounding * S);
    EXPECT_GT(eigenvalues[1], 0);
  }
}

// x of degree 0, S of degree −1, T of degree −2, Q of degree −3: the body may be asked with normals of any length.
TEST_P(SurfaceConformance, DegreesInTheNormal) {
  const Vector3 nu = Normal(), u = random_.Unit();
  const SupportJet one = Jet(nu), two = Jet(2 * nu);
  EXPECT_NEAR(two.h, 2 * one.h, kRounding * Size());
  EXPECT_TRUE(MatrixNear(two.x, one.x, kRounding * Size()));
  EXPECT_TRUE(MatrixNear(2 * two.S, one.S, kRounding * one.S.norm()));
  const double third = one.Third(u).norm() + one.S.norm(), fourth = one.Fourth(u, u).norm() + third;
  EXPECT_TRUE(MatrixNear(4 * two.Third(u), one.Third(u), kRounding * third));
  EXPECT_TRUE(MatrixNear(8 * two.Fourth(u, u), one.Fourth(u, u), kRounding * fourth));
}

TEST_P(SurfaceConformance, EveryDerivativeIsThatOfTheOneBefore) {
  const double step = 0.02 * GetParam().angle;
  for (int n = 0; n < kNormals; ++n) {
    const Vector3 nu = Normal(), u = random_.Unit(), w = random_.Unit();
    const SupportJet jet = Jet(nu);
    const auto at = [&](double t) { return Jet(nu + t * u); };
    const auto h = [&](double t) { return Eigen::Matrix<double, 1, 1>(at(t).h); };
    const auto x = [&](double t) { return at(t).x; };
    const auto S = [&](double t) { return at(t).S; };
    const auto T = [&](double t) { return at(t).Third(w); };
    // Truncation: eight steps of 2 % of the angle over which the function changes; rounding: ε over the step.
    const double S_norm = jet.S.norm(), T_norm = jet.Third(u).norm() + S_norm;
    const double Q_norm = jet.Fourth(u, w).norm() + jet.Third(w).norm() + T_norm;
    EXPECT_NEAR(HighOrderDifference(h, step)(0), jet.x.dot(u), 1e-10 * Size());
    EXPECT_TRUE(MatrixNear(HighOrderDifference(x, step), jet.S * u, 1e-9 * (Size() + S_norm)));
    EXPECT_TRUE(MatrixNear(HighOrderDifference(S, step), jet.Third(u), 1e-8 * T_norm));
    EXPECT_TRUE(MatrixNear(HighOrderDifference(T, step), jet.Fourth(u, w), 1e-7 * Q_norm));
    EXPECT_GT(jet.S.norm(), 1e-3 * Size());
  }
}

TEST_P(SurfaceConformance, ScalesWithTheBody) {
  const double scale = 1024;  // a power of two: what is left is Newton's residual
  const Surface large = GetParam().make(scale);
  for (int n = 0; n < kNormals; ++n) {
    const Vector3 nu = Normal(), u = random_.Unit();
    const SupportJet jet = Jet(nu);
    SupportJet other;
    large.Evaluate(nu, 4, &other);
    EXPECT_NEAR(other.h / scale, jet.h, kRounding * Size());
    EXPECT_TRUE(MatrixNear(other.x / scale, jet.x, kRounding * Size()));
    EXPECT_TRUE(MatrixNear(other.S / scale, jet.S, kRounding * jet.S.norm()));
    EXPECT_TRUE(MatrixNear(other.Third(u) / scale, jet.Third(u), kRounding * (jet.Third(u).norm() + jet.S.norm())));
    EXPECT_TRUE(
        MatrixNear(other.Fourth(u, u) / scale, jet.Fourth(u, u), kRounding * (jet.Fourth(u, u).norm() + jet.S.norm())));
  }
}

// Rolling a ball over a body adds the ball: to h, x, S, T and Q alike.
TEST_P(SurfaceConformance, RoundingAddsABall) {
  const double radius = 0.25;
  const Surface rounded = surface_.Rounded(radius);
  const Ellipsoid ball(Vector3::Constant(radius));
  const Vector3 center(1, -2, 0.5);
  const Surface moved = rounded.MovedTo(surface_.center() + center);
  for (int n = 0; n < kNormals; ++n) {
    const Vector3 nu = Normal(), u = random_.Unit(), w = random_.Unit();
    const SupportJet jet = Jet(nu);
    SupportJet sum, elsewhere;
    rounded.Evaluate(nu, 4, &sum);
    moved.Evaluate(nu, 4, &elsewhere);
    EXPECT_NEAR(sum.h, jet.h + radius, kRounding * Size());
    EXPECT_TRUE(MatrixNear(sum.x, jet.x + radius * nu, kRounding * Size()));
    EXPECT_TRUE(MatrixNear(sum.S, jet.S + ball.SupportHessian(nu), kRounding * sum.S.norm()));
    EXPECT_TRUE(MatrixNear(sum.Third(u), jet.Third(u) + ball.SupportThird(nu, u),
                           kRounding * (sum.Third(u).norm() + sum.S.norm())));
    EXPECT_TRUE(MatrixNear(sum.Fourth(u, w), jet.Fourth(u, w) + ball.SupportFourth(nu, u, w),
                           kRounding * (sum.Fourth(u, w).norm() + sum.Third(u).norm() + sum.S.norm())));
    EXPECT_NEAR(elsewhere.h, sum.h + nu.dot(center), kRounding * (Size() + center.norm()));
    EXPECT_TRUE(MatrixNear(elsewhere.x, sum.x + center, kRounding * (Size() + center.norm())));
    EXPECT_EQ(elsewhere.S, sum.S);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SurfaceConformance, ::testing::ValuesIn(SurfaceCases()),
                         [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace rollgait
