#include "client/import/leg_chains.h"

#include <algorithm>
#include <limits>
#include <string>

#include "client/import/foot_fit.h"
#include "client/import/mirror_names.h"

namespace rollgait::client {
namespace {

v1::BodySide SideOf(const LinkTree& tree, const TreePosture& posture, int joint) {
  const auto child = static_cast<size_t>(tree.joints[static_cast<size_t>(joint)].child);
  for (const std::string& name : {tree.joints[static_cast<size_t>(joint)].name, tree.links[child].name}) {
    if (MirrorNameOf(name).side != v1::BODY_SIDE_UNSPECIFIED) return MirrorNameOf(name).side;
  }
  const double y = posture.links[child].position.y();
  return y > 0.01 ? v1::BODY_SIDE_LEFT : y < -0.01 ? v1::BODY_SIDE_RIGHT : v1::BODY_SIDE_UNSPECIFIED;
}

// Of what the joint moves, m.
double Lowest(const LinkTree& tree, const TreePosture& posture, int joint) {
  const std::vector<int> links = LinksMovedBy(posture, joint);
  if (const auto extent = ExtentOf(tree, posture, links)) return extent->least.z();
  double lowest = std::numeric_limits<double>::infinity();
  for (const int link : links) lowest = std::min(lowest, posture.links[static_cast<size_t>(link)].position.z());
  return lowest;
}

}  // namespace

int LegEnd(const LinkTree& tree, const TreePosture& posture, const std::vector<bool>& locked, v1::BodySide side) {
  const auto moves = [&](size_t i) { return tree.joints[i].Moves() && !locked[i]; };
  int end = -1;
  for (size_t i = 0; i < tree.joints.size(); ++i) {
    const int joint = static_cast<int>(i);
    if (!moves(i) || SideOf(tree, posture, joint) != side) continue;
    bool is_last = true;
    for (size_t k = 0; k < tree.joints.size(); ++k) is_last = is_last && !(moves(k) && posture.behind[k] == joint);
    if (is_last && (end < 0 || Lowest(tree, posture, joint) < Lowest(tree, posture, end))) end = joint;
  }
  return end;
}

std::vector<int> LegTo(const TreePosture& posture, int end, int other) {
  const std::vector<int> shared = other < 0 ? std::vector<int>() : ChainTo(posture, other);
  std::vector<int> leg = ChainTo(posture, end);
  leg.erase(std::remove_if(leg.begin(), leg.end(),
                           [&](int i) { return std::find(shared.begin(), shared.end(), i) != shared.end(); }),
            leg.end());
  return leg;
}

Eigen::Vector3d LeftOfKnees(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& leg) {
  for (size_t k = 1; k < leg.size(); ++k) {
    const auto i = static_cast<size_t>(leg[k]);
    const TreeJoint& joint = tree.joints[i];
    if (joint.type != TreeJoint::Type::kRevolute || joint.upper == -joint.lower) continue;
    return (joint.upper > -joint.lower ? 1 : -1) * posture.axes[i];
  }
  return Eigen::Vector3d::Zero();
}

}  // namespace rollgait::client
