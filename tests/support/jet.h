#ifndef ROLLGAIT_TESTS_SUPPORT_JET_H_
#define ROLLGAIT_TESTS_SUPPORT_JET_H_

#include <cmath>

#include "core/base/types.h"

namespace rollgait {

// A value with its gradient and Hessian by at most kVariables variables: exact derivatives of formulas as they are
// written (forward mode).
struct Jet {
  static constexpr int kVariables = 11;
  using Gradient = Eigen::Matrix<double, kVariables, 1>;
  using Hessian = Eigen::Matrix<double, kVariables, kVariables>;

  double value = 0;
  Gradient gradient = Gradient::Zero();
  Hessian hessian = Hessian::Zero();

  Jet() = default;
  Jet(double constant) : value(constant) {}  // NOLINT: constants enter formulas as they are written.
  static Jet Variable(double at, int index) {
    Jet jet(at);
    jet.gradient(index) = 1;
    return jet;
  }

  // f(this), from the value and the first two derivatives of f.
  Jet Through(double f, double first, double second) const {
    Jet jet(f);
    jet.gradient = first * gradient;
    jet.hessian = first * hessian + second * gradient * gradient.transpose();
    return jet;
  }

  friend Jet operator+(Jet a, const Jet& b) {
    a.value += b.value;
    a.gradient += b.gradient;
    a.hessian += b.hessian;
    return a;
  }
  friend Jet operator-(const Jet& a) { return a.Through(-a.value, -1, 0); }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet jet(a.value * b.value);
    jet.gradient = a.value * b.gradient + b.value * a.gradient;
    jet.hessian = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() +
                  b.gradient * a.gradient.transpose();
    return jet;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double r = 1 / b.value;
    return a * b.Through(r, -r * r, 2 * r * r * r);
  }
};

inline Jet sin(const Jet& a) { return a.Through(std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
inline Jet cos(const Jet& a) { return a.Through(std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }
inline Jet exp(const Jet& a) { return a.Through(std::exp(a.value), std::exp(a.value), std::exp(a.value)); }

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_JET_H_
