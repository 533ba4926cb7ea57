// The tree of a Model message as formats see it whose bodies all have mass and may have several joints.
#ifndef ROLLGAIT_CLIENT_FORMATS_BODY_LINKS_H_
#define ROLLGAIT_CLIENT_FORMATS_BODY_LINKS_H_

#include <Eigen/Core>
#include <vector>

#include "client/report/kinematics.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// A link with mass, and the joints between it and the link with mass that carries it.
struct BodyLink {
  std::vector<int> joints;  // indices in Model.joints, from the carrying link on; the last one's link is the body
  int parent;               // index of the carrying body; -1 is the world

  int link() const { return joints.back(); }
};

// Parents first, in the order of Model.joints. Throws Failure(kUsage) that names the joint for a free joint, a parent
// that does not come before its joint, and a link without mass that carries no link or more than one.
std::vector<BodyLink> BodyLinks(const v1::Model& model);

// Index of the body that each joint of the model moves, or that carries it on its way there.
std::vector<int> BodyOfJoint(const v1::Model& model, const std::vector<BodyLink>& bodies);

// b in the axes and from the origin of a.
Pose Relative(const Pose& a, const Pose& b);

// Mass properties of a link, in its frame.
struct LinkMass {
  double mass;                     // kg
  Eigen::Vector3d center_of_mass;  // m
  Eigen::Matrix3d inertia;         // kg m², about the centre of mass
};
// Throws Failure(kUsage) for a joint whose inertia does not have six entries.
LinkMass MassOf(const v1::Joint& joint);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_BODY_LINKS_H_
