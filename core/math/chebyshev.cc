#include "core/math/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.h"

namespace rollgait {

ChebyshevBasis::ChebyshevBasis(int degree, int samples) {
  ROLLGAIT_CHECK(degree >= 2 && samples >= 1);
  const int n = degree;
  const auto angle = [n](int i) { return std::numbers::pi * (n - i) / n; };  // x_i = cos(angle) ascends from −1
  transform_.resize(n + 1, n + 1);
  for (int i = 0; i <= n; ++i) {
    // sin² keeps the small nodes accurate.
    const double half = std::sin(0.5 * std::numbers::pi * i / n);
    nodes_.push_back(half * half);
    for (int k = 0; k <= n; ++k) {
      const double halves = (i == 0 || i == n ? 0.5 : 1.0) * (k == 0 || k == n ? 0.5 : 1.0);
      transform_(i, k) = 2.0 / n * halves * std::cos(k * angle(i));
    }
  }
  nodes_.back() = 1;
  dense_.resize(n + 1, samples + 1);
  for (int j = 0; j <= samples; ++j) {
    grid_.push_back(static_cast<double>(j) / samples);
    const double x = std::acos(std::clamp(2 * grid_[j] - 1, -1.0, 1.0));
    for (int k = 0; k <= n; ++k) dense_(k, j) = std::cos(k * x);
  }
}

double ChebyshevBasis::Evaluate(const MatrixX& coefficients, int row, double theta) {
  const double x = 2 * theta - 1;
  double next = 0, after = 0;
  for (int k = static_cast<int>(coefficients.cols()) - 1; k > 0; --k) {
    const double current = coefficients(row, k) + 2 * x * next - after;
    after = next;
    next = current;
  }
  return coefficients(row, 0) + x * next - after;
}

double ChebyshevBasis::Tail(const MatrixX& coefficients, int row) {
  const int n = static_cast<int>(coefficients.cols()) - 1;
  return std::abs(coefficients(row, n)) + std::abs(coefficients(row, n - 1));
}

}  // namespace rollgait
