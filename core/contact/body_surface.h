#ifndef ROLLGAIT_CORE_CONTACT_BODY_SURFACE_H_
#define ROLLGAIT_CORE_CONTACT_BODY_SURFACE_H_

#include <string>

#include "core/contact/contact_pair.h"

namespace rollgait {

// A part of the body that has a thickness: a strictly convex surface fixed to a link. It exchanges no force; it only
// must not overlap others. See rollgait.v1.BodySurface.
struct BodySurface {
  std::string name;
  int joint = 0;         // whose link carries it
  PlacedSurface placed;  // in the link frame
  int mirror_body = 0;   // index of the left/right mirror image
};

// Two bodies that can meet: a joint between them moves one relative to the other. See rollgait.v1.BodyPair.
struct BodyPair {
  int first = 0, second = 0;  // indices of the bodies
  int mirror_pair = 0;        // index of the left/right mirror image
  bool usual = false;         // most walks meet here if nothing keeps the two apart
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_BODY_SURFACE_H_
