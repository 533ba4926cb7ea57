#include "core/math/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/validation/refinement.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

// Kepler's ellipse of eccentricity 0.5, from the pericentre; period 2π.
void Kepler(double, const VectorX& x, VectorX* dx) {
  const double r = x.head(2).norm();
  *dx << x[2], x[3], -x[0] / (r * r * r), -x[1] / (r * r * r);
}

VectorX KeplerStart() { return Eigen::Vector4d(0.5, 0, 0, std::sqrt(3.0)); }

TEST(Dop853, OrderOfTheSolutionIsEight) {
  std::vector<MeshError> errors;
  for (int steps : {100, 140, 200}) {
    Dop853 integrator;
    VectorX x = KeplerStart(), next;
    const double h = 2 * M_PI / steps;
    for (int i = 0; i < steps; ++i) {
      integrator.Step(Kepler, i * h, x, h, 1e-10, &next);
      x = next;
    }
    errors.push_back({h, (x - KeplerStart()).norm()});
  }
  const auto order = ObserveOrder(errors);
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(order->order, 8.0, 0.5);
}

// The right-hand side depends on t alone: the nodes c_i and the weights must agree.
TEST(Dop853, IntegratesPolynomialsInTime) {
  Dop853 integrator;
  VectorX x = VectorX::Zero(1), next;
  integrator.Step([](double t, const VectorX&, VectorX* dx) { (*dx)[0] = 8 * std::pow(t, 7); }, 0, x, 1.5, 1e-10,
                  &next);
  EXPECT_NEAR(next[0], std::pow(1.5, 8), 1e-13);
}

TEST(Dop853, ErrorControlMeetsTheTolerance) {
  double previous = kInfinity;
  for (double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    Dop853 integrator;
    Dop853::Options options;
    options.tolerance = tolerance;
    VectorX x = KeplerStart();
    ASSERT_EQ(integrator.Integrate(Kepler, 0, 2 * M_PI, options, &x), IntegrationStatus::kReachedEnd);
    const double error = (x - KeplerStart()).norm();
    // One revolution enlarges a local error some 2π·3 / (1 − e) times.
    EXPECT_LT(error, 100 * tolerance);
    EXPECT_LT(error, previous);
    previous = error;
  }
}

TEST(Dop853, StepsFollowTheProblem) {
  Dop853 integrator;
  Dop853::Options options;
  VectorX x = KeplerStart();
  std::vector<double> times;
  integrator.Integrate(Kepler, 1, 1 + 2 * M_PI, options, &x, [&](double t, const VectorX&) { times.push_back(t); });
  EXPECT_EQ(times.front(), 1);
  EXPECT_EQ(times.back(), 1 + 2 * M_PI);
  EXPECT_EQ(static_cast<int>(times.size()), integrator.accepted_steps() + 1);
  EXPECT_GT(integrator.accepted_steps(), 5);
  EXPECT_LT(integrator.accepted_steps(), 60);
  EXPECT_GT(integrator.proposed_step(), 0);
}

// Error of the continuous extension at the middle of a step of Kepler's ellipse against ever shorter steps; order 7
// means an error of h⁸ within one step.
TEST(Dop853, InterpolationWithinAStepIsOfOrderSeven) {
  std::vector<MeshError> errors;
  for (double h : {0.05, 0.07, 0.1}) {
    Dop853 integrator;
    double t = 0.3, worst = 0;
    VectorX x = Eigen::Vector4d(0.4, 0.3, -1.1, 1.3), between, exact;
    const VectorX start = x;
    int attempts = 0;
    integrator.Start(Kepler, t, x, h);
    ASSERT_EQ(integrator.Advance(Kepler, t + h, 1, 10, &t, &x, &attempts), IntegrationStatus::kReachedEnd);
    integrator.PrepareInterpolation(Kepler);
    integrator.Interpolate(integrator.step_start(), &between);
    EXPECT_TRUE(MatrixNear(between, start, 1e-15));
    integrator.Interpolate(t, &between);
    EXPECT_TRUE(MatrixNear(between, x, 1e-14));
    for (double s : {0.2, 0.5, 0.9}) {
      Dop853 fine;
      exact = start;
      Dop853::Options options;
      options.tolerance = 1e-15;
      fine.Integrate(Kepler, 0.3, 0.3 + s * h, options, &exact);
      integrator.Interpolate(0.3 + s * h, &between);
      worst = std::max(worst, (between - exact).norm());
    }
    errors.push_back({h, worst});
  }
  const auto order = ObserveOrder(errors);
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(order->order, 8.0, 0.7);
}

// A quadrature of any size changes no step.
TEST(Dop853, QuadraturesDoNotTakePartInTheErrorControl) {
  Dop853 plain, with;
  Dop853::Options options;
  VectorX x = KeplerStart(), extended(5);
  extended << KeplerStart(), 0;
  with.SetQuadratures(1);
  const auto right_side = [](double t, const VectorX& y, VectorX* dy) {
    VectorX part(4);
    Kepler(t, y, &part);
    *dy << part, 1e9 * y[1];
  };
  ASSERT_EQ(plain.Integrate(Kepler, 0, M_PI, options, &x), IntegrationStatus::kReachedEnd);
  ASSERT_EQ(with.Integrate(right_side, 0, M_PI, options, &extended), IntegrationStatus::kReachedEnd);
  EXPECT_TRUE(MatrixNear(extended.head(4), x, 0));
  EXPECT_EQ(with.accepted_steps(), plain.accepted_steps());
  EXPECT_GT(extended[4], 1e8);
}

TEST(Dop853, AnEmptySpanDoesNothing) {
  Dop853 integrator;
  VectorX x = KeplerStart();
  EXPECT_EQ(integrator.Integrate(Kepler, 2, 2, {}, &x), IntegrationStatus::kReachedEnd);
  EXPECT_TRUE(MatrixNear(x, KeplerStart(), 0));
}

TEST(Dop853, SaysWhenItFails) {
  Dop853 integrator;
  VectorX x = VectorX::Ones(1);
  // x' = x² leaves every bound at t = 1.
  const auto blow_up = [](double, const VectorX& y, VectorX* dy) { *dy = y.cwiseAbs2(); };
  EXPECT_NE(integrator.Integrate(blow_up, 0, 2, {}, &x), IntegrationStatus::kReachedEnd);
  x = VectorX::Ones(1);
  const auto nan = [](double t, const VectorX&, VectorX* dy) {
    (*dy)[0] = t > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  };
  EXPECT_EQ(integrator.Integrate(nan, 0, 1, {}, &x), IntegrationStatus::kNotFinite);
  EXPECT_LT(x[0], 1.5 + 1e-9);
  x = KeplerStart();
  Dop853::Options few;
  few.max_steps = 3;
  EXPECT_EQ(integrator.Integrate(Kepler, 0, 2 * M_PI, few, &x), IntegrationStatus::kTooManySteps);
}

}  // namespace
}  // namespace rollgait
