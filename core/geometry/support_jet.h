#ifndef ROLLGAIT_CORE_GEOMETRY_SUPPORT_JET_H_
#define ROLLGAIT_CORE_GEOMETRY_SUPPORT_JET_H_

#include <array>

#include "core/base/types.h"

namespace rollgait {

// The support function h of a convex body at one normal ν, and its derivatives by ν (m; docs/explanation/notation.md).
// All derivatives are totally symmetric; T and Q are kept by components. Every function that fills a jet fills it up to
// the order asked for: 1 = h and x, 2 = S, 3 = T, 4 = Q. Members above that order are not touched.
struct SupportJet {
  double h = 0;              // distance from the origin to the tangent plane with normal ν
  Vector3 x;                 // ∇h: the point of the surface with outward normal ν
  Matrix3 S;                 // ∇²h: inverse Weingarten map, Sν = 0
  std::array<Matrix3, 3> T;  // T[k] = ∂S/∂ν_k
  std::array<Matrix3, 6> Q;  // ∂²S/∂ν_k∂ν_l at index PairIndex(k, l)
  // The highest derivative (1 … 4, at most the order asked for) that exists and is finite at this ν. Derivatives above
  // it have every entry +infinity: S where the surface is flat, T and Q at edges and where curvature is not smooth.
  int order = 0;

  static int PairIndex(int k, int l) {
    constexpr int kIndex[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    return kIndex[k][l];
  }
  Matrix3 Third(const Vector3& u) const { return u[0] * T[0] + u[1] * T[1] + u[2] * T[2]; }
  // D_ν T[k][w].
  Matrix3 FourthOf(int k, const Vector3& w) const {
    return w[0] * Q[PairIndex(k, 0)] + w[1] * Q[PairIndex(k, 1)] + w[2] * Q[PairIndex(k, 2)];
  }
  Matrix3 Fourth(const Vector3& u, const Vector3& w) const {
    return u[0] * FourthOf(0, w) + u[1] * FourthOf(1, w) + u[2] * FourthOf(2, w);
  }

  // Writes one value to every place of T or Q that has these indices in any order.
  void SetThird(const int* ijk, double value);
  void SetFourth(const int* ijkl, double value);
  // Lowers `order` to what is finite and fills everything above it, up to `asked`, with infinity.
  void MarkMissing(int asked);
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_SUPPORT_JET_H_
