#ifndef ROLLGAIT_CORE_MATH_POLYNOMIAL_EXTREMA_H_
#define ROLLGAIT_CORE_MATH_POLYNOMIAL_EXTREMA_H_

#include <span>

namespace rollgait {

// Extrema of a polynomial on [0, 1], and where they are (the first of equal ones).
struct PolynomialRange {
  double min = 0, max = 0;
  double min_at = 0, max_at = 0;
};

inline constexpr int kLargestDegree = 8;

// Extrema of  c_0 + c_1 x + … + c_n x^n  on [0, 1], exact but for rounding: roots of the derivative are isolated
// between the roots of the next derivative. Contract: 1 to kLargestDegree + 1 coefficients; leading ones may vanish. If
// a coefficient is not finite, the range is all numbers.
PolynomialRange RangeOnUnitInterval(std::span<const double> coefficients);

// Where the same polynomial changes its sign in (0, 1), ascending, at most n places; returns how many. It misses roots
// of even multiplicity, where it touches zero only. Contract: coefficients finite, room for n roots.
int SignChangesOnUnitInterval(std::span<const double> coefficients, double* roots);

// By Horner's rule.
double EvaluatePolynomial(std::span<const double> coefficients, double x);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_POLYNOMIAL_EXTREMA_H_
