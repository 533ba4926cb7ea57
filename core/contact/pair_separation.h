#ifndef ROLLGAIT_CORE_CONTACT_PAIR_SEPARATION_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_SEPARATION_H_

#include "core/geometry/surface.h"

namespace rollgait {

// Two surfaces in world axes.
struct PosedSurface {
  const Surface* surface = nullptr;
  Matrix3 R_WE;  // surface axes -> world
  Vector3 p_WE;  // m
};

// The signed distance of two strictly convex bodies: the maximum over unit ν of
//   g(ν) = ν · (c₂ − c₁) − h₁(ν) − h₂(−ν),
// with ν from body 1 to body 2. Source: contact-math 8.
struct Separation {
  Vector3 nu;                   // unit, world
  double distance = 0;          // m, g(ν); negative: overlap along ν
  Vector3 r_1, r_2;             // m, world: from the origins of the surfaces to the contact points
  int iterations = 0;           // Newton steps, all starts together
  int support_evaluations = 0;  // of the search for a separating plane
  // True if the last Newton step was at rounding level. False only if the budget of steps ran out, which takes surfaces
  // that bend over less than rounding can resolve; ν, distance and points are then the best found.
  bool converged = false;
  // kSeparated: the bodies are disjoint and this is the distance (it is unique). kOverlap: no plane separates them; ν
  // is a local maximum of g, the one that the start leads to: there are several ways to push bodies apart. kTouching:
  // they touch within rounding, so neither could be shown.
  enum class State { kSeparated, kOverlap, kTouching } state = State::kTouching;
};

// Newton's method for ν on the sphere with a line search on g. g is concave, so for disjoint bodies every start from
// which g is positive ends at the distance. If it ends at g < 0, a search for a separating plane (Gilbert, Johnson and
// Keerthi 1988) decides between overlap and a wrong start and gives a right one. `start`: unit normal of a
// configuration close by, for branch following; null: the line of origins, and for overlapping bodies also their six
// axes each, of which the least overlap is returned (not guaranteed to be the least of all).
Separation FindSeparation(const PosedSurface& body_1, const PosedSurface& body_2, const Vector3* start);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_SEPARATION_H_
