#include "core/math/cubic_spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rollgait {
namespace {

TEST(CubicSpline, TwoValuesAreALine) {
  const CubicSpline spline({1, 4});
  EXPECT_DOUBLE_EQ(spline.Value(0), 1);
  EXPECT_DOUBLE_EQ(spline.Value(0.25), 1.75);
  EXPECT_DOUBLE_EQ(spline.Value(1), 4);
  EXPECT_DOUBLE_EQ(spline.First(0.6), 3);
  EXPECT_DOUBLE_EQ(spline.Second(0.6), 0);
}

// The natural spline through 0, 1, 0 is 3 θ − 4 θ³ up to θ = 1/2 and symmetric.
TEST(CubicSpline, ThreeValuesInClosedForm) {
  const CubicSpline spline({0, 1, 0});
  for (double theta : {0.0, 0.1, 0.25, 0.4, 0.5}) {
    EXPECT_NEAR(spline.Value(theta), 3 * theta - 4 * theta * theta * theta, 1e-15) << theta;
    EXPECT_NEAR(spline.Value(1 - theta), spline.Value(theta), 1e-15) << theta;
    EXPECT_NEAR(spline.First(theta), 3 - 12 * theta * theta, 1e-14) << theta;
    EXPECT_NEAR(spline.Second(theta), -24 * theta, 1e-14) << theta;
  }
}

TEST(CubicSpline, PassesThroughItsValuesAndIsTwiceContinuous) {
  const std::vector<double> values = {0.3, -0.2, 0.7, 0.1, 0.1, -1.5};
  const CubicSpline spline(values);
  for (size_t i = 0; i < values.size(); ++i) {
    const double knot = static_cast<double>(i) / 5, step = 1e-9;
    EXPECT_NEAR(spline.Value(knot), values[i], 1e-13);
    // A jump would stay as the step shrinks; derivatives up to the third are below 1e4 here.
    EXPECT_NEAR(spline.First(knot - step), spline.First(knot + step), 1e-5);
    EXPECT_NEAR(spline.Second(knot - step), spline.Second(knot + step), 1e-4);
  }
  EXPECT_NEAR(spline.Second(0), 0, 1e-12);
  EXPECT_NEAR(spline.Second(1), 0, 1e-12);
}

TEST(CubicSpline, DerivativesMeetDifferences) {
  const CubicSpline spline({0.3, -0.2, 0.7, 0.1, 0.1, -1.5});
  const double step = 1e-5;
  for (double theta : {-0.05, 0.07, 0.33, 0.55, 0.91, 1.04}) {
    const double first = (spline.Value(theta + step) - spline.Value(theta - step)) / (2 * step);
    const double second = (spline.First(theta + step) - spline.First(theta - step)) / (2 * step);
    // Truncation is step² times the third derivative (1e3), rounding 1e-16/step.
    EXPECT_NEAR(spline.First(theta), first, 1e-6) << theta;
    EXPECT_NEAR(spline.Second(theta), second, 1e-6) << theta;
  }
}

// A sine has no curvature at its ends, so the natural end conditions cost no order.
TEST(CubicSpline, ConvergesWithTheFourthPower) {
  const auto error = [](int pieces) {
    std::vector<double> values;
    for (int i = 0; i <= pieces; ++i) values.push_back(std::sin(2 * M_PI * i / pieces));
    const CubicSpline spline(values);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      worst = std::max(worst, std::abs(spline.Value(i / 1000.0) - std::sin(2 * M_PI * i / 1000.0)));
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(16) / error(32)), 4, 0.2);
}

}  // namespace
}  // namespace rollgait
