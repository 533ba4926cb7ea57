#include "core/ocp/costs/power_price.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollgait {
namespace {

struct Prices {
  double positive, negative, smoothing;
};
// Equal ones; those of muscles; the reverse; the most unequal ones a request may ask for.
constexpr Prices kPrices[] = {{1, 1, 20},  {4, 1 / 1.2, 20},  {4, 1 / 1.2, 0.01},
                              {0.5, 3, 5}, {100, 0.01, 1000}, {0.01, 100, 1000}};
constexpr double kPowers[] = {1e-9, 1e-3, 0.1, 1, 5, 17.3, 20, 1e2, 1e3, 1e6};

double WithCorner(const Prices& prices, double power) {
  return power > 0 ? prices.positive * power : -prices.negative * power;
}

// The hyperbola as it is written, in long double.
long double Hyperbola(const Prices& prices, long double power) {
  const long double c = (prices.positive + prices.negative) / 2.0L;
  const long double t = (prices.positive - static_cast<long double>(prices.negative)) / (2 * c), e = prices.smoothing;
  return c * (std::sqrt(power * power - 2 * t * e * power + e * e) - e + t * power);
}

TEST(PowerPrice, IsTheHyperbola) {
  for (const Prices& prices : kPrices) {
    const PowerPrice price(prices.positive, prices.negative, prices.smoothing);
    for (const double size : kPowers) {
      for (const double power : {-size, size}) {
        // Long double loses 1e-19 of the largest summand, and t near 1 costs a factor 1/(1 − t²) = 2500 in double.
        const double rounding = 1e-18 * price.mean() * (size + prices.smoothing) * 10;
        EXPECT_NEAR(price.At(power).value, static_cast<double>(Hyperbola(prices, power)),
                    rounding + 1e-12 * price.At(power).value)
            << prices.positive << " " << prices.negative << " " << power;
      }
    }
  }
}

// An energy cannot be negative, nor more than the price with the corner; it is less by the price of ε at most.
TEST(PowerPrice, LiesBetweenNothingAndThePriceWithTheCorner) {
  constexpr double kRounding = 1e-12;
  for (const Prices& prices : kPrices) {
    const PowerPrice price(prices.positive, prices.negative, prices.smoothing);
    for (const double size : kPowers) {
      for (const double power : {-size, size}) {
        const double corner = WithCorner(prices, power), value = price.At(power).value;
        const double least = corner * std::max(0.0, 1 - prices.smoothing / size);
        EXPECT_GT(value, 0) << power;
        EXPECT_EQ(price.Unsmoothed(power), corner);
        EXPECT_GE(value, least * (1 - kRounding)) << power;
        EXPECT_LE(value, corner * (1 + kRounding)) << power;
      }
    }
  }
}

TEST(PowerPrice, NothingCostsNothingAndIsTheLowestPoint) {
  for (const Prices& prices : kPrices) {
    const PowerPrice::Jet at_rest = PowerPrice(prices.positive, prices.negative, prices.smoothing).At(0);
    EXPECT_EQ(at_rest.value, 0);
    EXPECT_EQ(at_rest.first, 0);
    EXPECT_GT(at_rest.second, 0);
  }
}

TEST(PowerPrice, SlopesAreThePricesFarFromZero) {
  for (const Prices& prices : kPrices) {
    const PowerPrice price(prices.positive, prices.negative, prices.smoothing);
    const double far = 1e9 * prices.smoothing;
    EXPECT_NEAR(price.At(far).first / prices.positive, 1, 1e-9);
    EXPECT_NEAR(price.At(-far).first / -prices.negative, 1, 1e-9);
  }
}

TEST(PowerPrice, DerivativesMeetDifferencesOfTheHyperbola) {
  for (const Prices& prices : kPrices) {
    const PowerPrice price(prices.positive, prices.negative, prices.smoothing);
    for (double x = -3; x <= 3; x += 0.21) {
      const double power = x * prices.smoothing;
      const long double step = 1e-5L * prices.smoothing;
      const long double here = Hyperbola(prices, power);
      const long double ahead = Hyperbola(prices, power + step), behind = Hyperbola(prices, power - step);
      const PowerPrice::Jet jet = price.At(power);
      // Truncation: 1e-10 of the third derivative, which of a hyperbola with t near 1 is 1/(1 − t²) = 2500 times the
      // price over ε².
      const double slope_size = price.mean(), curvature_size = price.mean() / prices.smoothing;
      const double bend = prices.positive * prices.negative / (price.mean() * price.mean());
      const double slope = static_cast<double>((ahead - behind) / (2 * step));
      const double curvature = static_cast<double>((ahead - 2 * here + behind) / (step * step));
      EXPECT_NEAR(jet.first, slope, 1e-9 / bend * slope_size) << power;
      EXPECT_NEAR(jet.second, curvature, 1e-7 / bend * curvature_size) << power;
    }
  }
}

}  // namespace
}  // namespace rollgait
