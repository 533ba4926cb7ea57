#ifndef ROLLGAIT_CORE_VALIDATION_ELLIPSOID_OVERLAP_H_
#define ROLLGAIT_CORE_VALIDATION_ELLIPSOID_OVERLAP_H_

#include "core/base/types.h"

namespace rollgait {

// An ellipsoid in world axes.
struct PosedEllipsoid {
  Matrix3 R_WE = Matrix3::Identity();   // principal axes -> world
  Vector3 p_WE = Vector3::Zero();       // m, centre
  Vector3 semi_axes = Vector3::Ones();  // m
};

// Distance of the two planes with unit normal nu (from a to b) that touch a and b, m; positive if nu separates them.
double PlaneDistance(const PosedEllipsoid& a, const PosedEllipsoid& b, const Vector3& nu);

// Whether two ellipsoids overlap, by the largest factor by which both can be scaled about their centres without
// overlap: its square is the maximum over s in (0, 1) of the concave function  s (1 − s) rᵀ ((1 − s) Q_a + s Q_b)⁻¹ r
// with r from centre to centre and Q = R diag(semi-axes²) Rᵀ (Perram and Wertheim 1985, J Comput Phys 58:409). One
// unknown, found by bracketing; no code is shared with FindSeparation, and the answer has no start that could be wrong.
struct ScaledContact {
  double scale = 0;               // > 1: apart, < 1: they overlap; 0 if the centres coincide
  Vector3 nu = Vector3::UnitZ();  // unit normal of the common tangent plane of the scaled ellipsoids, from a to b
};
ScaledContact FindScaledContact(const PosedEllipsoid& a, const PosedEllipsoid& b);

// m, the shortest translation that parts two ellipsoids that overlap, else 0: minus the largest PlaneDistance, found by
// direct search on the sphere from the scaled contact and, where that is deeper than 1 mm, from the axes of both. Never
// less than the shortest; within 1e-9 m of it where one of these starts leads to it.
double OverlapDepth(const PosedEllipsoid& a, const PosedEllipsoid& b);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_ELLIPSOID_OVERLAP_H_
