#ifndef ROLLGAIT_CORE_CONTACT_PAIR_TANGENT_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_TANGENT_H_

#include "core/contact/pair_separation.h"

namespace rollgait {

// S₁ + S₂ + d I of two bodies on the plane ⟂ ν, in the tangent basis where it is diagonal: this is what Newton's method
// and every derivative of a pair solve with. In that basis the smaller curvature keeps its own digits (contact-math
// 9.2).
struct PairTangent {
  PairTangent(const PosedSurface& body_1, const PosedSurface& body_2, const Vector3& nu, double distance);

  Eigen::Matrix<double, 3, 2> basis;  // world, orthonormal, ⟂ ν
  Eigen::Matrix2d S_1, S_2;           // m, in that basis; infinite where a surface is flat
  Eigen::Vector2d curvature;          // m, diagonal of S₁ + S₂ + d I; the rest is rounding
  bool finite = true;                 // neither surface is flat here

  // Components of a world vector in the basis, and the solution of (S₁ + S₂ + d I) y = z.
  Eigen::Vector2d Components(const Vector3& u) const { return basis.transpose() * u; }
  Eigen::Vector2d Solve(const Eigen::Vector2d& z) const { return inverse_ * z; }

 private:
  Eigen::Matrix2d inverse_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_TANGENT_H_
