#ifndef ROLLGAIT_CORE_MATH_ASSIGN_DUAL_H_
#define ROLLGAIT_CORE_MATH_ASSIGN_DUAL_H_

#include <type_traits>

#include "core/base/dual.h"

namespace rollgait {

// to = value + ε derivative for code that is written once for double, which drops the derivative, and for Dual. All
// three have the same shape.
template <typename To, typename A, typename B>
void AssignDual(To& to, const A& value, const B& derivative) {
  for (Eigen::Index j = 0; j < to.cols(); ++j) {
    for (Eigen::Index i = 0; i < to.rows(); ++i) {
      if constexpr (std::is_same_v<typename To::Scalar, Dual>) {
        to(i, j) = Dual(value(i, j), derivative(i, j));
      } else {
        to(i, j) = value(i, j);
      }
    }
  }
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_ASSIGN_DUAL_H_
