#include "core/math/polynomial_extrema.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Coefficients = std::array<double, kLargestDegree + 1>;

// The root in [left, right] of a polynomial that is monotone there, with values of opposite sign at the ends: Newton's
// method, with bisection wherever a step would leave the bracket or does not halve it.
double RootIn(std::span<const double> c, double left, double right, bool rising) {
  double x = 0.5 * (left + right);
  // A bracket is halved at least every other step, and has 53 bits.
  for (int i = 0; i < 120; ++i) {
    double value = 0, slope = 0;
    for (int j = static_cast<int>(c.size()) - 1; j >= 0; --j) {
      slope = slope * x + value;
      value = value * x + c[j];
    }
    if (value == 0) return x;
    ((value > 0) == rising ? right : left) = x;
    const double newton = x - value / slope;
    const bool inside = newton > left && newton < right && i % 2 == 0;
    const double next = inside ? newton : 0.5 * (left + right);
    if (next == x || next <= left || next >= right) return next;
    if (inside && std::abs(next - x) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(next)) return next;
    x = next;
  }
  return x;
}

}  // namespace

double EvaluatePolynomial(std::span<const double> c, double x) {
  double value = 0;
  for (int j = static_cast<int>(c.size()) - 1; j >= 0; --j) value = value * x + c[j];
  return value;
}

int SignChangesOnUnitInterval(std::span<const double> c, double* roots) {
  const int n = static_cast<int>(c.size()) - 1;
  ROLLGAIT_CHECK(n >= 0 && n <= kLargestDegree);
  // From the derivative of degree 1 up to the polynomial itself: between two sign changes of its derivative it is
  // monotone.
  std::array<double, kLargestDegree> breaks{};
  int count = 0;
  for (int order = n - 1; order >= 0; --order) {
    Coefficients d{};
    for (int j = order; j <= n; ++j) {
      double factor = 1;
      for (int i = 0; i < order; ++i) factor *= j - i;
      d[j - order] = factor * c[j];
    }
    const std::span<const double> derivative(d.data(), n - order + 1);
    std::array<double, kLargestDegree> found{};
    int changes = 0;
    double left = 0, before = EvaluatePolynomial(derivative, 0);
    for (int i = 0; i <= count; ++i) {
      const double right = i < count ? breaks[i] : 1.0;
      const double after = EvaluatePolynomial(derivative, right);
      if ((before < 0 && after > 0) || (before > 0 && after < 0)) {
        found[changes++] = RootIn(derivative, left, right, after > 0);
      }
      // A break on which the polynomial vanishes belongs to neither side: the sign before it is kept.
      if (after != 0) before = after;
      left = right;
    }
    breaks = found;
    count = changes;
  }
  for (int i = 0; i < count; ++i) roots[i] = breaks[i];
  return count;
}

PolynomialRange RangeOnUnitInterval(std::span<const double> c) {
  const int n = static_cast<int>(c.size()) - 1;
  ROLLGAIT_CHECK(n >= 0 && n <= kLargestDegree);
  for (double value : c) {
    if (!std::isfinite(value)) {
      return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0, 0};
    }
  }
  Coefficients d{};
  for (int j = 1; j <= n; ++j) d[j - 1] = j * c[j];
  std::array<double, kLargestDegree + 1> places{};
  int count = n > 1 ? SignChangesOnUnitInterval({d.data(), static_cast<size_t>(n)}, places.data()) : 0;
  places[count++] = 1;
  PolynomialRange range{c[0], c[0], 0, 0};
  for (int i = 0; i < count; ++i) {
    const double value = EvaluatePolynomial(c, places[i]);
    if (value < range.min) range.min = value, range.min_at = places[i];
    if (value > range.max) range.max = value, range.max_at = places[i];
  }
  return range;
}

}  // namespace rollgait
