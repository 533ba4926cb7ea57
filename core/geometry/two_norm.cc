#include "core/geometry/two_norm.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

// coefficient · base^exponent with the limits that polynomials have: 0 · anything = 0, base 0 as a limit from above.
double Power(double base, double exponent) {
  if (exponent == 0) return 1;
  if (base == 0) return exponent > 0 ? 0 : HUGE_VAL;
  return std::pow(base, exponent);
}

}  // namespace

TwoNorm::TwoNorm(double u, double v, double q) : q_(q) {
  const double large = std::max(u, v), small = std::min(u, v);
  const double ratio = small / large;
  // N = large (1 + ratio^q)^(1/q)
  const double factor = std::exp(std::log1p(std::pow(ratio, q)) / q);
  value_ = large * factor;
  const double large_part = 1 / factor, small_part = ratio / factor;
  u_ = u >= v ? large_part : small_part;
  v_ = u >= v ? small_part : large_part;
}

// F by repeated use of  F_(i+1)j = (P − i + u ∂/∂u) F_ij,  F_i(j+1) = (R − j + v ∂/∂v) F_ij,  made homogeneous with
// P + R = 1. Each entry of i + j ≥ 2 is (q − 1) times a sum of c P^α R^β with α, β ≥ 1.
double TwoNorm::Scaled(int i, int j, int shift_u, int shift_v) const {
  const double q = q_;
  const auto term = [&](double coefficient, int alpha, int beta) {
    if (coefficient == 0) return 0.0;
    const double p = Power(u_, alpha * q - shift_u), r = Power(v_, beta * q - shift_v);
    return p == 0 || r == 0 ? 0.0 : coefficient * p * r;
  };
  if (i + j == 0) return Power(u_, -shift_u) * Power(v_, -shift_v);
  if (i + j == 1) return i == 1 ? term(1, 1, 0) : term(1, 0, 1);
  const double a = q - 1;
  switch (10 * i + j) {
    case 20:
    case 2:
      return term(a, 1, 1);
    case 11:
      return term(-a, 1, 1);
    case 30:
      return term(a * (q - 2), 1, 2) + term(-a * (q + 1), 2, 1);
    case 21:
      return term(a * q, 2, 1) + term(-a * a, 1, 2);
    case 12:
      return term(a * q, 1, 2) + term(-a * a, 2, 1);
    case 3:
      return term(a * (q - 2), 2, 1) + term(-a * (q + 1), 1, 2);
    case 40:
      return term(a * (q - 2) * (q - 3), 1, 3) + term(-a * (4 * q - 7) * (q + 1), 2, 2) +
             term(a * (q + 1) * (q + 2), 3, 1);
    case 31:
      return term(-a * a * (q - 2), 1, 3) + term(a * a * (4 * q + 1), 2, 2) + term(-a * q * (q + 1), 3, 1);
    case 22:
      return term(a * a * q, 1, 3) + term(a * a * q, 3, 1) + term(-a * ((4 * q - 3) * q + 1), 2, 2);
    case 13:
      return term(-a * a * (q - 2), 3, 1) + term(a * a * (4 * q + 1), 2, 2) + term(-a * q * (q + 1), 1, 3);
    default:
      return term(a * (q - 2) * (q - 3), 3, 1) + term(-a * (4 * q - 7) * (q + 1), 2, 2) +
             term(a * (q + 1) * (q + 2), 1, 3);
  }
}

}  // namespace rollgait
