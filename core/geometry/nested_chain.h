#ifndef ROLLGAIT_CORE_GEOMETRY_NESTED_CHAIN_H_
#define ROLLGAIT_CORE_GEOMETRY_NESTED_CHAIN_H_

#include "core/geometry/two_norm.h"

namespace rollgait {

// Derivatives of f(N(t₁, t₂)) with respect to t for a function f of one number and the norm N of TwoNorm, by the chain
// rule: the sum over all partitions of the indices into blocks, of f^(blocks) and one derivative of N for each block.
// With N's derivatives scaled to N = 1 and `outer(blocks, k)` standing for f^(blocks) N^(blocks − k), no small number
// is divided by. At t₁ = t₂ = 0 the derivatives are the limits along t₁ = t₂, which is right wherever f(N) is smooth.
class NestedChain {
 public:
  NestedChain(double t_1, double t_2, double q)
      : tip_(t_1 == 0 && t_2 == 0), norm_(tip_ ? TwoNorm(1, 1, q) : TwoNorm(t_1, t_2, q)) {}

  double value() const { return tip_ ? 0 : norm_.value(); }  // N
  bool tip() const { return tip_; }

  // Needed before derivatives of that order.
  void Prepare(int order) {
    for (int i = 0; i <= order; ++i) {
      for (int j = 0; i + j <= order; ++j) d_[i][j] = norm_.Scaled(i, j, i, j);
    }
  }

  // The derivative with respect to t at k indices e (each 0 or 1), k ≤ 4.
  template <typename Outer>
  double Derivative(const Outer& outer, const int* e, int k) const {
    switch (k) {
      case 0:
        return outer(0, 0);
      case 1:
        return outer(1, 1) * D(e[0]);
      case 2:
        return outer(2, 2) * D(e[0]) * D(e[1]) + outer(1, 2) * D(e[0], e[1]);
      case 3:
        return outer(3, 3) * D(e[0]) * D(e[1]) * D(e[2]) +
               outer(2, 3) * (D(e[0], e[1]) * D(e[2]) + D(e[0], e[2]) * D(e[1]) + D(e[1], e[2]) * D(e[0])) +
               outer(1, 3) * D(e[0], e[1], e[2]);
      default:
        return outer(4, 4) * D(e[0]) * D(e[1]) * D(e[2]) * D(e[3]) +
               outer(3, 4) * (D(e[0], e[1]) * D(e[2]) * D(e[3]) + D(e[0], e[2]) * D(e[1]) * D(e[3]) +
                              D(e[0], e[3]) * D(e[1]) * D(e[2]) + D(e[1], e[2]) * D(e[0]) * D(e[3]) +
                              D(e[1], e[3]) * D(e[0]) * D(e[2]) + D(e[2], e[3]) * D(e[0]) * D(e[1])) +
               outer(2, 4) *
                   (D(e[0], e[1]) * D(e[2], e[3]) + D(e[0], e[2]) * D(e[1], e[3]) + D(e[0], e[3]) * D(e[1], e[2]) +
                    D(e[0], e[1], e[2]) * D(e[3]) + D(e[0], e[1], e[3]) * D(e[2]) + D(e[0], e[2], e[3]) * D(e[1]) +
                    D(e[1], e[2], e[3]) * D(e[0])) +
               outer(1, 4) * D(e[0], e[1], e[2], e[3]);
    }
  }

 private:
  template <typename... Index>
  double D(Index... index) const {
    const int second = (0 + ... + index);
    return d_[static_cast<int>(sizeof...(index)) - second][second];
  }

  bool tip_;
  TwoNorm norm_;
  double d_[5][5] = {};
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_NESTED_CHAIN_H_
