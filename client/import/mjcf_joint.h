// Hinges, slides and balls of MJCF bodies.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_

#include <string>
#include <vector>

#include "client/import/link_tree.h"
#include "client/import/mjcf_values.h"

namespace rollgait::client {

// The word of its type: "hinge", "slide", "ball" or "free". Throws Failure(kUsage) for another.
std::string MjcfJointType(const MjcfElement& joint);

// A hinge or a slide: its origin is its anchor in the frame of the parent element, its name is not set. Says in
// `left_out` what a model does not have. Throws Failure(kUsage) for a limited joint without range.
TreeJoint ReadMjcfJoint(const MjcfElement& joint, LeftOut* left_out);

// The name of the turn of a ball joint about x (0), y (1) or z (2): "hip_y".
std::string MjcfTurnName(const std::string& ball, int axis);
// A ball joint as turns about y, x and z of its body, in this order: the outer ones as far as the file's range of the
// whole angle, or without limits, the second at most ±80°, since at ±90° the three lose a direction. Origins
// are not set. What spring and damper of a ball do is told in `left_out`.
std::vector<TreeJoint> ReadMjcfBall(const MjcfElement& joint, const std::string& name, LeftOut* left_out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_JOINT_H_
