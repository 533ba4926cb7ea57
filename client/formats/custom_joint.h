// A chain of joints as one OpenSim CustomJoint.
#ifndef ROLLGAIT_CLIENT_FORMATS_CUSTOM_JOINT_H_
#define ROLLGAIT_CLIENT_FORMATS_CUSTOM_JOINT_H_

#include <Eigen/Core>
#include <vector>

#include "client/formats/body_links.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// One axis of OpenSim's SpatialTransform. Rotations are taken one after the other about body-fixed axes.
struct TransformAxis {
  Eigen::Vector3d axis;  // unit, in the parent frame at zero positions
  int joint = -1;        // whose position it is; -1: fixed at zero
};

struct CustomJoint {
  Pose parent_frame;                        // in the link frame of the carrying body
  Eigen::Matrix3d child_frame;              // joint frame -> link frame of the body; the origins coincide
  std::vector<TransformAxis> rotations;     // three, independent
  std::vector<TransformAxis> translations;  // three, independent, in the parent frame
};

// In the service's axes. Throws Failure(kUsage) that names the joint where the chain is more than three translations
// followed by three rotations about one point.
CustomJoint ToCustomJoint(const v1::Model& model, const BodyLink& body);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_CUSTOM_JOINT_H_
