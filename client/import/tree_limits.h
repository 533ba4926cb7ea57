// Ranges and limits of a model's joint, from a tree and its side file.
#ifndef ROLLGAIT_CLIENT_IMPORT_TREE_LIMITS_H_
#define ROLLGAIT_CLIENT_IMPORT_TREE_LIMITS_H_

#include <string>

#include "client/import/tree_model.h"

namespace rollgait::client {

// Throws Failure(kUsage) if the reference of a joint is out of its range, which `least` and `most` are for revolute and
// prismatic joints and ±2π for others.
void RequireReference(const LinkTree& tree, const TreeJoint& joint, const std::string& side_path,
                      const v1::SideJoint& said, double least, double most);

// Sets position, velocity and effort limits and `actuated` of `to`, as ModelSideFile says, positions counted from the
// reference. Says in `result` what is from the side file and what is assumed. Joints of the base have no limit where
// the file has kUrdfUnlimited, others where the format has no limits of velocity 20 rad/s or 2 m/s. Throws
// Failure(kUsage) for an empty range, a reference out of range, and an actuated joint without limits.
void SetLimits(const LinkTree& tree, const TreeJoint& joint, const std::string& side_path, const v1::SideJoint& said,
               v1::Joint* to, ImportedModel* result);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_TREE_LIMITS_H_
