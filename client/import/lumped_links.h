// Links that do not move against each other, as one body.
#ifndef ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_
#define ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_

#include <vector>

#include "client/import/urdf_tree.h"

namespace rollgait::client {

// A frame that is fixed in `a`, given in `b` of `a`: the pose of the product.
Pose Compose(const Pose& a, const Pose& b);

// The joint's child frame in its joint frame at a position (rad or m); the identity for joints of one or more other
// degrees of freedom.
Pose MotionOf(const UrdfJoint& joint, double position);

// The same mass properties in the frame that `place` places the given one in.
UrdfMass Placed(const UrdfMass& mass, const Pose& place);

// Mass properties of bodies that are fixed to each other, all in one frame: masses add up, inertias about the common
// centre of mass by the parallel-axis theorem. One body alone is returned to the bit; without mass: zero.
UrdfMass Lump(const std::vector<UrdfMass>& masses);

// Principal moments about the centre of mass, kg m², in ascending order.
Eigen::Vector3d PrincipalMoments(const UrdfMass& mass);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_LUMPED_LINKS_H_
