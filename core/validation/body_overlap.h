#ifndef ROLLGAIT_CORE_VALIDATION_BODY_OVERLAP_H_
#define ROLLGAIT_CORE_VALIDATION_BODY_OVERLAP_H_

#include <functional>
#include <memory>

#include "core/base/types.h"

namespace rollgait {

// A body in world axes: an ellipsoid, or with `norm` any other.
struct PosedBody {
  Matrix3 R_WE = Matrix3::Identity();   // principal axes -> world
  Vector3 p_WE = Vector3::Zero();       // m, centre
  Vector3 semi_axes = Vector3::Ones();  // m, half a box about p_WE that holds the body
  // The support function in m, in the body's own axes; null of an ellipsoid.
  std::shared_ptr<const std::function<double(const Vector3&)>> norm = nullptr;
};

// Distance of the two planes with unit normal nu (from a to b) that touch a and b, m; positive if nu separates them.
double PlaneDistance(const PosedBody& a, const PosedBody& b, const Vector3& nu);

// Whether two bodies overlap, by the largest factor by which both can be scaled about their centres without overlap.
// With r from centre to centre it is 1 over the minimum of the convex function  h_a(ν) + h_b(−ν)  on the plane ν · r
// = 1. Of two ellipsoids its square is the maximum over s in (0, 1) of the concave function
//   s (1 − s) rᵀ ((1 − s) Q_a + s Q_b)⁻¹ r,  Q = R diag(semi-axes²) Rᵀ
// (Perram and Wertheim 1985, J Comput Phys 58:409): one unknown, found by bracketing. With another body direct
// search on the plane goes on from there. No code is shared with FindSeparation, and no start could be wrong.
struct ScaledContact {
  double scale = 0;               // > 1: apart, < 1: they overlap; 0 if the centres coincide
  Vector3 nu = Vector3::UnitZ();  // unit normal of the common tangent plane of the scaled bodies, from a to b
};
ScaledContact FindScaledContact(const PosedBody& a, const PosedBody& b);

// m, the shortest translation that parts two bodies that overlap, else 0: minus the largest PlaneDistance, found by
// direct search on the sphere from the scaled contact and, where that is deeper than 1 mm, from the axes of both. Never
// less than the shortest; within 1e-9 m of it where one of these starts leads to it.
double OverlapDepth(const PosedBody& a, const PosedBody& b);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_BODY_OVERLAP_H_
