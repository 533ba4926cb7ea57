// Ranges and limits of a model's joint, from the URDF and its side file.
#ifndef ROLLGAIT_CLIENT_IMPORT_URDF_LIMITS_H_
#define ROLLGAIT_CLIENT_IMPORT_URDF_LIMITS_H_

#include <string>

#include "client/import/urdf_model.h"

namespace rollgait::client {

// Throws Failure(kUsage) if the reference of a joint is out of its range, which `least` and `most` are for revolute and
// prismatic joints and ±2π for others.
void RequireReference(const UrdfTree& tree, const UrdfJoint& joint, const std::string& side_path,
                      const v1::SideJoint& said, double least, double most);

// Sets position, velocity and effort limits and `actuated` of `to`, as ModelSideFile says, positions counted from the
// reference. Says in `result` what is from the side file and what is assumed. Joints of the base have no limit where
// the URDF has kUrdfUnlimited. Throws Failure(kUsage) for an empty range, a reference out of range, and an actuated
// joint without limits.
void SetLimits(const UrdfTree& tree, const UrdfJoint& joint, const std::string& side_path, const v1::SideJoint& said,
               v1::Joint* to, UrdfModel* result);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_LIMITS_H_
