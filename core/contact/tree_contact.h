#ifndef ROLLGAIT_CORE_CONTACT_TREE_CONTACT_H_
#define ROLLGAIT_CORE_CONTACT_TREE_CONTACT_H_

#include <string>
#include <variant>

#include "core/contact/contact_pair.h"

namespace rollgait {

// Which relative velocities of the contact points an active contact forbids besides the one along the normal.
enum class Grip {
  kRolling,       // both tangent directions
  kRollingAlong,  // one tangent direction: mechanisms that move in a plane
  kFrictionless,  // none
};

// A possible contact of a tree: a surface on one of its links (body 1) with a plane or surface of body 2, which is
// another link or the ground.
struct TreeContact {
  std::string name;
  int link = 0;  // of body 1
  PlacedSurface surface;
  int other_link = -1;  // of body 2; -1: the ground
  int ground = 0;       // which of the ground's frames, if other_link is -1
  std::variant<PlacedPlane, PlacedSurface> other = PlacedPlane{};
  Grip grip = Grip::kRolling;
  Vector3 along = Vector3::UnitX();  // for kRollingAlong: a direction in body 2's axes, not along the normal
  bool no_spin = false;              // also forbid relative spin about the normal
};

// An active contact that slides: it holds its gap, and friction is `friction` times the normal force against the slip.
struct Sliding {
  double friction = 0;
  // Unit tangent, world: the direction of slip a moment ago. Friction acts against  ± w + kSlidingBlend · reference  (w
  // the slip, with the sign that turns it towards the reference), so that it has a limit where slip begins or ends, and
  // goes on smoothly through zero, where an event is to be found. Along a straight line that is Coulomb's law exactly;
  // elsewhere the direction is off by kSlidingBlend / |w| times the turn since the reference.
  Vector3 reference = Vector3::UnitX();
};
inline constexpr double kSlidingBlend = 1e-6;  // m/s

// Rows that an active contact without slip adds to the equations; their order is in ContactDynamics.
inline int RowCount(const TreeContact& contact) {
  const int directions = contact.grip == Grip::kRolling ? 3 : contact.grip == Grip::kRollingAlong ? 2 : 1;
  return directions + (contact.no_spin ? 1 : 0);
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_TREE_CONTACT_H_
