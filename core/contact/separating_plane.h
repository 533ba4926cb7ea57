#ifndef ROLLGAIT_CORE_CONTACT_SEPARATING_PLANE_H_
#define ROLLGAIT_CORE_CONTACT_SEPARATING_PLANE_H_

#include "core/contact/pair_separation.h"

namespace rollgait {

struct SeparatingPlane {
  // kFound: g(ν) > 0. kNone: points of the difference of the bodies have the origin in their hull, within rounding:
  // they overlap. kUndecided: rounding or the budget of support evaluations ended the search while they touch.
  enum class State { kFound, kNone, kUndecided } state = State::kUndecided;
  Vector3 nu = Vector3::UnitZ();
  int support_evaluations = 0;
};

// Searches for ν with g(ν) > 0 by the distance of the origin from the Minkowski difference body 2 − body 1, which grows
// from support points (Gilbert, Johnson and Keerthi 1988). It needs nothing but support points, has no start to be
// wrong, and finds the plane of disjoint bodies in a finite number of steps.
SeparatingPlane FindSeparatingPlane(const PosedSurface& body_1, const PosedSurface& body_2);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_SEPARATING_PLANE_H_
