#ifndef ROLLGAIT_CORE_CONTACT_ADMISSIBLE_FORCES_H_
#define ROLLGAIT_CORE_CONTACT_ADMISSIBLE_FORCES_H_

#include <span>
#include <vector>

#include "core/base/types.h"

namespace rollgait {

// A contact of a rigid link with the ground, normal +z, and the force (or impulse) of the ground on the link, world
// axes. Where a direction is not transmitted, that component of the force is zero and stays so.
struct LinkContact {
  Vector3 point;                        // m
  Vector3 force;                        // N or N s
  bool along_x = true, along_y = true;  // tangent directions that are transmitted
};

// Two or more contacts of one rigid link have internal forces that its motion does not depend on: with two contacts,
// any multiple of the line between them, added to one force and taken from the other. What does depend on the motion is
// the net wrench. The functions below choose among all distributions with the same net wrench (contacts that all
// transmit no y belong to a mechanism in the plane y = 0, which sees of the wrench F_x, F_z and M_y only).

// The shift s that makes the larger of  |t_1 + s d| / n_1  and  |t_2 − s d| / n_2  as small as it can be. Exact: both
// are convex in s, and the larger is least at the bottom of one of them or where they cross. Contract: n_1, n_2 > 0, d
// not zero.
double LeastRatioShift(const Eigen::Vector2d& t_1, double n_1, const Eigen::Vector2d& t_2, double n_2,
                       const Eigen::Vector2d& d);

// Replaces forces by the admissible distribution of least norm: of all with the same net wrench and |t| <= friction · n
// at every contact, the one with the least Σ |f|², which is unique (a convex set, a strictly convex norm) and
// continuous in the wrench. Two contacts: closed form. More: Newton's method for the dual problem, wrench kept to 1e-9
// of its size. False if there is none (or, for more than two contacts, if it was not found): then two contacts that
// both push have the distribution whose larger ratio |t| / n is least (tangent parts only are shifted), and other
// forces stay as they were. Contract: friction >= 0 and finite, everything else finite.
bool AdmissibleForces(double friction, std::span<LinkContact> contacts);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_ADMISSIBLE_FORCES_H_
