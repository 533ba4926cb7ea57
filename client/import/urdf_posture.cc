#include "client/import/urdf_posture.h"

#include "client/import/lumped_links.h"

namespace rollgait::client {

UrdfPosture PostureOf(const UrdfTree& tree, const Pose& root, const std::map<std::string, double>& positions,
                      const std::vector<bool>& locked) {
  UrdfPosture posture;
  posture.links.assign(tree.links.size(), root);
  posture.moved_by.assign(tree.links.size(), -1);
  for (size_t i = 0; i < tree.joints.size(); ++i) {
    const UrdfJoint& joint = tree.joints[i];
    const auto parent = static_cast<size_t>(joint.parent), child = static_cast<size_t>(joint.child);
    const Pose frame = Compose(posture.links[parent], joint.origin);
    posture.axes.push_back(frame.rotation * joint.axis);
    const auto found = positions.find(joint.name);
    posture.links[child] = Compose(frame, MotionOf(joint, found == positions.end() ? 0.0 : found->second));
    posture.behind.push_back(posture.moved_by[parent]);
    const bool moves = joint.type == UrdfJoint::Type::kRevolute || joint.type == UrdfJoint::Type::kContinuous ||
                       joint.type == UrdfJoint::Type::kPrismatic;
    posture.moved_by[child] = moves && !locked[i] ? static_cast<int>(i) : posture.moved_by[parent];
  }
  return posture;
}

std::vector<int> ChainTo(const UrdfPosture& posture, int joint) {
  std::vector<int> chain;
  for (int at = joint; at >= 0; at = posture.behind[static_cast<size_t>(at)]) chain.insert(chain.begin(), at);
  return chain;
}

std::vector<int> LinksMovedBy(const UrdfPosture& posture, int joint) {
  std::vector<int> links;
  for (size_t i = 0; i < posture.moved_by.size(); ++i) {
    if (posture.moved_by[i] == joint) links.push_back(static_cast<int>(i));
  }
  return links;
}

}  // namespace rollgait::client
