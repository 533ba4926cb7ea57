#ifndef ROLLGAIT_CORE_TRANSCRIPTION_RETURNED_POINTS_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_RETURNED_POINTS_H_

#include "core/math/collocation.h"
#include "core/math/scheme.h"

namespace rollgait {

// In which points the motion within an interval is returned, and what makes their values of those of the scheme's
// points: value at returned point r = Σ_i matrix(r, i) · value at point i.
//   The polynomials of collocation run through its points, which are returned as they are. The stages of an explicit
// method lie on no polynomial that fits the nodes. Returned is its dense output, the polynomial of degree 4 through the
// positions and velocities of both nodes and the acceleration at the first: it is one of Hermite–Simpson,
//   a(0) = a₁,  a(½) = 3 bᵀA a − ½ a₁,  a(1) = 6 bᵀa − a(0) − 4 a(½),
// off by O(h⁵) in position where a step is. Efforts and forces are those of the polynomials through the stages.
struct ReturnedPoints {
  Scheme scheme;
  VectorX fractions;                      // of the interval
  MatrixX acceleration_map, control_map;  // returned points × points of the scheme
};

ReturnedPoints ReturnedPointsOf(Scheme scheme);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_RETURNED_POINTS_H_
