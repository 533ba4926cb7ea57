// Links that do not move against each other, as one body.
#ifndef ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_
#define ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_

#include <vector>

#include "client/import/link_tree.h"

namespace rollgait::client {

// A frame that is fixed in `a`, given in `b` of `a`: the pose of the product.
Pose Compose(const Pose& a, const Pose& b);

// The joint's moved frame in its joint frame at a position (rad or m) as the file counts it; the identity for joints
// that are fixed or have several degrees of freedom.
Pose MotionOf(const TreeJoint& joint, double position);

// The same mass properties in the frame that `place` places the given one in.
MassProperties Placed(const MassProperties& mass, const Pose& place);

// Mass properties of bodies that are fixed to each other, all in one frame: masses add up, inertias about the common
// centre of mass by the parallel-axis theorem. One body alone is returned to the bit; without mass: zero.
MassProperties Lump(const std::vector<MassProperties>& masses);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_
