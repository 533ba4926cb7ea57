// How far two bodies are inside each other, by search.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_

#include "bench/verdict_audit/smooth_body.h"

namespace rollgait::audit {

struct WorldBody {
  Vector3 center;  // m
  Matrix3 R_WE;    // its axes
  SmoothBody shape;
};

// The depth of the overlap, m: how far one must be moved at least to part from the other; 0 if they do not overlap.
// `direction` (unit) is where the search starts and gets where it ended: the next instant starts there.
double Overlap(const WorldBody& first, const WorldBody& second, Vector3* direction);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_OVERLAP_H_
