// How far two ellipsoids are inside each other, by search.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_

#include "core/base/types.h"

namespace rollgait::audit {

struct WorldEllipsoid {
  Vector3 center;     // m
  Matrix3 R_WE;       // its axes
  Vector3 semi_axes;  // m
};

// The depth of the overlap, m: how far one must be moved at least to part from the other; 0 if they do not overlap.
// `direction` (unit) is where the search starts and gets where it ended: the next instant starts there.
double Overlap(const WorldEllipsoid& first, const WorldEllipsoid& second, Vector3* direction);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_
