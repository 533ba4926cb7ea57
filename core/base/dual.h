#ifndef ROLLGAIT_CORE_BASE_DUAL_H_
#define ROLLGAIT_CORE_BASE_DUAL_H_

#include <Eigen/Core>
#include <cmath>

namespace rollgait {

// A value and its derivative along one direction (forward mode, one lane). Only the operations that contact kinematics
// needs: a missing one is a compile error.
struct Dual {
  double v = 0;
  double d = 0;

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: constants enter formulas as they are written.
  Dual(double value, double derivative) : v(value), d(derivative) {}

  Dual& operator+=(const Dual& o) { return *this = Dual(v + o.v, d + o.d); }
  Dual& operator-=(const Dual& o) { return *this = Dual(v - o.v, d - o.d); }
  Dual& operator*=(const Dual& o) { return *this = Dual(v * o.v, d * o.v + v * o.d); }
  Dual& operator/=(const Dual& o) { return *this = Dual(v / o.v, (d - v / o.v * o.d) / o.v); }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator-(const Dual& a) { return Dual(-a.v, -a.d); }
};

inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.v);
  return Dual(root, a.d / (2 * root));
}

}  // namespace rollgait

namespace Eigen {
template <>
struct NumTraits<rollgait::Dual> : NumTraits<double> {
  using Real = rollgait::Dual;
  using NonInteger = rollgait::Dual;
  using Nested = rollgait::Dual;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 4
  };
};
}  // namespace Eigen

#endif  // ROLLGAIT_CORE_BASE_DUAL_H_
