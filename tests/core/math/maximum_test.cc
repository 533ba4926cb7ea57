#include "core/math/maximum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rollgait {
namespace {

template <class F>
Maximum Find(const F& f, int steps) {
  std::vector<double> grid, samples;
  for (int k = 0; k <= steps; ++k) {
    grid.push_back(static_cast<double>(k) / steps);
    samples.push_back(f(grid.back()));
  }
  return MaximumOverGrid(f, grid, samples);
}

TEST(MaximumOverGrid, BetweenTheSamples) {
  for (double at : {0.001, 0.3337, 0.5, 0.9999}) {
    const Maximum found = Find([at](double x) { return 3 - (x - at) * (x - at); }, 10);
    EXPECT_NEAR(found.value, 3, 1e-12);
    EXPECT_NEAR(found.at, at, 1e-6);
  }
}

TEST(MaximumOverGrid, TheHigherOfTwoPeaksThoughItsSampleIsLower) {
  // Peaks of 1 at a sample and of 1.02 halfway between two, where the samples see 0.794.
  const auto f = [](double x) {
    const double a = 10 * (x - 0.2), b = 10 * (x - 0.75);
    return std::exp(-a * a) + 1.02 * std::exp(-b * b);
  };
  ASSERT_LT(f(0.7), f(0.2));
  ASSERT_LT(f(0.8), f(0.2));
  const Maximum found = Find(f, 10);
  EXPECT_NEAR(found.value, 1.02, 1e-9);
  EXPECT_NEAR(found.at, 0.75, 1e-5);
}

TEST(MaximumOverGrid, AtTheEndsAndOnAPlateau) {
  EXPECT_EQ(Find([](double x) { return x; }, 7).at, 1);
  EXPECT_EQ(Find([](double x) { return -x; }, 7).at, 0);
  EXPECT_EQ(Find([](double) { return 5.0; }, 7).value, 5);
  // A kink, as of the larger of two functions.
  const Maximum found = Find([](double x) { return -std::abs(x - 0.31); }, 7);
  EXPECT_NEAR(found.value, 0, 1e-6);
}

}  // namespace
}  // namespace rollgait
