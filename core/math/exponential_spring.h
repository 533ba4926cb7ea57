#ifndef ROLLGAIT_CORE_MATH_EXPONENTIAL_SPRING_H_
#define ROLLGAIT_CORE_MATH_EXPONENTIAL_SPRING_H_

#include <array>
#include <cmath>

namespace rollgait {

// p(x) = offset + Σ k_i exp(s_i x) of a coordinate x in rad; p in N m, s in 1/rad. It pushes back on both sides if
// every k_i s_i <= 0. All zero: no spring. Immutable value.
struct ExponentialSpring {
  struct Term {
    double k = 0, s = 0;
  };
  double offset = 0;
  std::array<Term, 3> terms{};

  // Value and first two derivatives by x.
  struct Jet {
    double value, first, second;
  };
  Jet At(double x) const {
    Jet jet{offset, 0, 0};
    for (const Term& term : terms) {
      if (term.k == 0) continue;
      const double p = term.k * std::exp(term.s * x);
      jet.value += p;
      jet.first += term.s * p;
      jet.second += term.s * term.s * p;
    }
    return jet;
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_EXPONENTIAL_SPRING_H_
