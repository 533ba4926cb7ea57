// Forward kinematics of a Model message.
#ifndef ROLLGAIT_CLIENT_REPORT_KINEMATICS_H_
#define ROLLGAIT_CLIENT_REPORT_KINEMATICS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

inline Eigen::Vector3d ToVector(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }
// An unset quaternion is the identity.
Eigen::Matrix3d ToRotation(const v1::Quaternion& q);

// Pose of a link frame in the world.
struct Pose {
  Eigen::Matrix3d rotation;  // link -> world
  Eigen::Vector3d position;  // m
};

// Poses of all links; `positions` (rad, m) in the order of Model.joints. Throws Failure(kUsage) if the sizes differ or
// a joint's parent does not come before it.
std::vector<Pose> LinkPoses(const v1::Model& model, const std::vector<double>& positions);

// The lowest point of a surface in the world; the contact point if the surface touches the ground. Throws
// Failure(kUsage) for a contact that is on no joint of the poses, or as ShapeOf.
Eigen::Vector3d LowestPoint(const v1::ContactSurface& contact, const std::vector<Pose>& poses);

// In which direction a positive position moves what hangs on the joint, at the zero posture: "forward", "backward",
// "up" or "down" for the mass centre of the subtree; "left" or "right" if it moves sideways most; "" if it does not
// move.
std::string PositiveDirection(const v1::Model& model, int joint);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_KINEMATICS_H_
