#include "core/math/bernstein.h"

#include <Eigen/LU>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

double Binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

}  // namespace

MatrixX BernsteinFromMonomials(int degree) {
  ROLLGAIT_CHECK(degree >= 0 && degree <= 20);
  MatrixX m = MatrixX::Zero(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    for (int k = 0; k <= i; ++k) m(i, k) = Binomial(i, k) / Binomial(degree, k);
  }
  return m;
}

MatrixX BernsteinFromValues(const VectorX& c) {
  const int s = static_cast<int>(c.size());
  MatrixX basis(s, s);  // of the Bernstein polynomials at c
  for (int i = 0; i < s; ++i) {
    for (int k = 0; k < s; ++k) basis(i, k) = Binomial(s - 1, k) * std::pow(c(i), k) * std::pow(1 - c(i), s - 1 - k);
  }
  MatrixX m = basis.inverse();
  // Rounding of the elimination is a structural zero or one: a coefficient at a point is the value there.
  for (double& value : m.reshaped()) {
    if (std::abs(value) < 1e-12) value = 0;
    if (std::abs(value - 1) < 1e-12) value = 1;
  }
  return m;
}

}  // namespace rollgait
