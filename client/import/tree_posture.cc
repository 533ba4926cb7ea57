#include "client/import/tree_posture.h"

#include "client/import/lumped_links.h"

namespace rollgait::client {

TreePosture PostureOf(const LinkTree& tree, const Pose& root, const std::map<std::string, double>& positions,
                      const std::vector<bool>& locked) {
  TreePosture posture;
  posture.links.assign(tree.links.size(), root);
  posture.moved_by.assign(tree.links.size(), -1);
  for (size_t i = 0; i < tree.joints.size(); ++i) {
    const TreeJoint& joint = tree.joints[i];
    const auto parent = static_cast<size_t>(joint.parent), child = static_cast<size_t>(joint.child);
    const Pose frame = Compose(posture.links[parent], joint.origin);
    posture.axes.push_back(frame.rotation * joint.axis);
    const auto found = positions.find(joint.name);
    const Pose moved = Compose(frame, MotionOf(joint, found == positions.end() ? 0.0 : found->second));
    posture.joints.push_back(moved.position);
    posture.links[child] = Compose(moved, joint.end);
    posture.behind.push_back(posture.moved_by[parent]);
    posture.moved_by[child] = joint.Moves() && !locked[i] ? static_cast<int>(i) : posture.moved_by[parent];
  }
  return posture;
}

std::vector<int> ChainTo(const TreePosture& posture, int joint) {
  std::vector<int> chain;
  for (int at = joint; at >= 0; at = posture.behind[static_cast<size_t>(at)]) chain.insert(chain.begin(), at);
  return chain;
}

std::vector<int> LinksMovedBy(const TreePosture& posture, int joint) {
  std::vector<int> links;
  for (size_t i = 0; i < posture.moved_by.size(); ++i) {
    if (posture.moved_by[i] == joint) links.push_back(static_cast<int>(i));
  }
  return links;
}

std::vector<bool> JointsWithoutMass(const LinkTree& tree) {
  std::vector<double> behind(tree.links.size(), 0);
  std::vector<bool> moves_none(tree.joints.size(), false);
  for (size_t i = 0; i < tree.links.size(); ++i) behind[i] = tree.links[i].mass.mass;
  for (size_t i = tree.joints.size(); i-- > 0;) {
    const TreeJoint& joint = tree.joints[i];
    moves_none[i] = behind[static_cast<size_t>(joint.child)] == 0;
    behind[static_cast<size_t>(joint.parent)] += behind[static_cast<size_t>(joint.child)];
  }
  return moves_none;
}

}  // namespace rollgait::client
