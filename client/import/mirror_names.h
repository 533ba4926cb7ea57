// Which side of the body a name speaks of, and the same name on the other side.
#ifndef ROLLGAIT_CLIENT_IMPORT_MIRROR_NAMES_H_
#define ROLLGAIT_CLIENT_IMPORT_MIRROR_NAMES_H_

#include <string>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

struct MirrorName {
  v1::BodySide side = v1::BODY_SIDE_UNSPECIFIED;  // of the name; unspecified: it speaks of no side
  std::string other;                              // with the sides exchanged; the name itself if it speaks of none
};

// Knows "left" and "right" in lower, upper and mixed case anywhere; "l" and "r" in either case between separators (_,
// -,
// ., space) or the ends: "hip_l", "L_KNEE"; and as first letter before a capital and a small letter or as last after a
// small letter: "LHipPitch", "KneeR". The first of these that applies decides.
MirrorName MirrorNameOf(const std::string& name);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MIRROR_NAMES_H_
