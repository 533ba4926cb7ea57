// Hinges and slides of MJCF bodies.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_

#include <string>

#include "client/import/link_tree.h"
#include "client/import/mjcf_values.h"

namespace rollgait::client {

// The word of its type: "hinge", "slide", "ball" or "free". Throws Failure(kUsage) for another.
std::string MjcfJointType(const MjcfElement& joint);

// A hinge or a slide: its origin is its anchor in the frame of the parent element, its name is not set. Says in
// `left_out` what a model does not have. Throws Failure(kUsage) for a limited joint without range.
TreeJoint ReadMjcfJoint(const MjcfElement& joint, LeftOut* left_out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_
