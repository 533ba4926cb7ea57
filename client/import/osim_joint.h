// What a joint of an .osim file does: one joint of a model for each coordinate.
#ifndef ROLLGAIT_CLIENT_IMPORT_OSIM_JOINT_H_
#define ROLLGAIT_CLIENT_IMPORT_OSIM_JOINT_H_

#include <vector>

#include "client/import/link_tree.h"
#include "client/import/osim_values.h"

namespace rollgait::client {

// From the joint's frame on the parent to that on the child: slides in the parent's axes, then turns, each about an
// axis as the turns before it have left it. Parents and children are not set.
struct OsimMotion {
  std::vector<TreeJoint> joints;
  Pose end = kNoMotion;  // the child's frame in the moved frame of the last joint
};

// Joints have the names and ranges of their coordinates. What moves by another function of a coordinate than itself or
// its negative, and locked coordinates, are held at the coordinate's default and told in `left_out`. Throws
// Failure(kUsage) for kinds of joints that are not in the table, and coordinates that are missing or not known.
OsimMotion ReadOsimMotion(const OsimElement& joint, LeftOut* left_out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_OSIM_JOINT_H_
