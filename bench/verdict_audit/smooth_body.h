// Superellipsoids with smoothing, for the second judge.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_SMOOTH_BODY_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_SMOOTH_BODY_H_

#include <optional>

#include "core/geometry/surface.h"

namespace rollgait::audit {

// An ellipsoid, or where it has exponents the superellipsoid of rollgait.v1.Superellipsoid with smoothing, by its
// definition.
struct SmoothBody {
  Vector3 semi_axes;  // m
  double exponent_1 = 1, exponent_2 = 1, smoothing = 0;

  double Support(const Vector3& nu) const;    // m
  Vector3 Furthest(const Vector3& nu) const;  // m, by complex steps of the support function
};

// Contract: the surface is one of these two, about the origin and not rounded.
SmoothBody BodyOf(const Surface& surface);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_SMOOTH_BODY_H_
