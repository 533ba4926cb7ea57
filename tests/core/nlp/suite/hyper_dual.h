#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_HYPER_DUAL_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_HYPER_DUAL_H_

#include <cmath>

namespace rollgait::suite {

// A value with its derivatives along two directions and the mixed second one (Fike and Alonso, AIAA 2011-886): exact to
// rounding. Formulas of the suite are written once, as templates, for double and for this.
struct HyperDual {
  double v = 0, a = 0, b = 0, ab = 0;

  HyperDual() = default;
  HyperDual(double value) : v(value) {}  // NOLINT: constants enter formulas as they are written.
  HyperDual(double value, double along_a, double along_b, double mixed) : v(value), a(along_a), b(along_b), ab(mixed) {}

  // f(x) from f, f' and f'' at x.v.
  static HyperDual Chain(const HyperDual& x, double f, double d, double dd) {
    return {f, d * x.a, d * x.b, d * x.ab + dd * x.a * x.b};
  }
  friend HyperDual operator+(const HyperDual& x, const HyperDual& y) {
    return {x.v + y.v, x.a + y.a, x.b + y.b, x.ab + y.ab};
  }
  friend HyperDual operator-(const HyperDual& x) { return {-x.v, -x.a, -x.b, -x.ab}; }
  friend HyperDual operator-(const HyperDual& x, const HyperDual& y) { return x + -y; }
  friend HyperDual operator*(const HyperDual& x, const HyperDual& y) {
    return {x.v * y.v, x.a * y.v + x.v * y.a, x.b * y.v + x.v * y.b, x.ab * y.v + x.a * y.b + x.b * y.a + x.v * y.ab};
  }
  friend HyperDual operator/(const HyperDual& x, const HyperDual& y) {
    return x * Chain(y, 1 / y.v, -1 / (y.v * y.v), 2 / (y.v * y.v * y.v));
  }
};

using std::cos;
using std::exp;
using std::log;
using std::sin;
using std::sqrt;
inline HyperDual exp(const HyperDual& x) { return HyperDual::Chain(x, std::exp(x.v), std::exp(x.v), std::exp(x.v)); }
inline HyperDual log(const HyperDual& x) { return HyperDual::Chain(x, std::log(x.v), 1 / x.v, -1 / (x.v * x.v)); }
inline HyperDual sin(const HyperDual& x) { return HyperDual::Chain(x, std::sin(x.v), std::cos(x.v), -std::sin(x.v)); }
inline HyperDual cos(const HyperDual& x) { return HyperDual::Chain(x, std::cos(x.v), -std::sin(x.v), -std::cos(x.v)); }
inline HyperDual sqrt(const HyperDual& x) {
  const double root = std::sqrt(x.v);
  return HyperDual::Chain(x, root, 0.5 / root, -0.25 / (root * x.v));
}

// x to a whole power, n >= 1.
template <typename T>
T Power(const T& x, int n) {
  T product = x;
  for (int k = 1; k < n; ++k) product = product * x;
  return product;
}
template <typename T>
T Square(const T& x) {
  return x * x;
}

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_HYPER_DUAL_H_
