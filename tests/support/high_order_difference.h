#ifndef ROLLGAIT_TESTS_SUPPORT_HIGH_ORDER_DIFFERENCE_H_
#define ROLLGAIT_TESTS_SUPPORT_HIGH_ORDER_DIFFERENCE_H_

namespace rollgait {

// f'(0) by the central difference of eighth order. `f` maps a double to anything with +, − and scaling. The error is
// about h⁸ f⁽⁹⁾/630 + 2 ε |f| / h: with h = 0.01 of the length over which f changes, both are near 1e-13.
template <typename F>
auto HighOrderDifference(const F& f, double h) {
  auto sum = (4.0 / 5 * (f(h) - f(-h))).eval();
  sum -= 1.0 / 5 * (f(2 * h) - f(-2 * h));
  sum += 4.0 / 105 * (f(3 * h) - f(-3 * h));
  sum -= 1.0 / 280 * (f(4 * h) - f(-4 * h));
  return (sum / h).eval();
}

// f''(0), of eighth order as well.
template <typename F>
auto HighOrderSecondDifference(const F& f, double h) {
  auto sum = (-205.0 / 72 * f(0.0)).eval();
  const double weights[] = {8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
  for (int k = 1; k <= 4; ++k) sum += weights[k - 1] * (f(k * h) + f(-k * h));
  return (sum / (h * h)).eval();
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_HIGH_ORDER_DIFFERENCE_H_
