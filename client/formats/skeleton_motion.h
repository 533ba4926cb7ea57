// The motion of bodies as rotations from a rest pose, for formats of computer animation.
#ifndef ROLLGAIT_CLIENT_FORMATS_SKELETON_MOTION_H_
#define ROLLGAIT_CLIENT_FORMATS_SKELETON_MOTION_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "client/report/stride.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// One body at one instant, the service's axes.
struct BoneState {
  Eigen::Matrix3d turned;    // from the rest pose, in the carrier's turned axes: identity at rest
  Eigen::Vector3d position;  // m, of the body's origin: of the root in the world, of others `Bone.offset`
};

struct Bone {
  std::string name;               // the link's
  int parent;                     // index of the carrying bone; -1: the root
  int joint;                      // index of the joint whose link it is
  Eigen::Vector3d offset;         // m, from the carrier's origin in the rest pose, world axes
  Eigen::Matrix3d rest;           // link axes -> world in the rest pose
  std::vector<BoneState> states;  // one for each sample of the stride
};

// The rest pose is that of all positions zero: upright, arms down. Throws Failure(kUsage) as BodyLinks, and where a
// body slides along another one or there are several roots.
std::vector<Bone> SkeletonMotion(const v1::Model& model, const Stride& stride);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_SKELETON_MOTION_H_
