#include "client/import/tree_chain.h"

#include <cmath>

#include "client/import/lumped_links.h"

namespace rollgait::client {
namespace {

constexpr double kIndependent = 1e-3;  // the least volume that independent unit axes span

enum class Base { kNone, kPlane, kSpace };

Base BaseOf(const TreeChain& chain) {
  std::vector<Eigen::Vector3d> slides, turns;  // axes in the world, every joint without motion
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  for (const TreeJoint& joint : chain.joints) {
    if (!joint.Moves() || !joint.mimics.empty() || !(joint.axis.norm() > 1e-6)) return Base::kNone;
    turned = turned * joint.origin.rotation;
    (joint.type == TreeJoint::Type::kPrismatic ? slides : turns).push_back(turned * joint.axis.normalized());
  }
  const auto volume = [](const std::vector<Eigen::Vector3d>& axes) {
    return std::abs(axes[0].cross(axes[1]).dot(axes[2]));
  };
  if (slides.size() == 3 && turns.size() == 3) {
    return volume(slides) > kIndependent && volume(turns) > kIndependent ? Base::kSpace : Base::kNone;
  }
  if (slides.size() != 2 || turns.size() != 1) return Base::kNone;
  const bool in_plane = std::abs(slides[0].y()) < 1e-6 && std::abs(slides[1].y()) < 1e-6 &&
                        std::abs(turns[0].y()) > 1 - 1e-6 && slides[0].cross(slides[1]).norm() > kIndependent;
  return in_plane ? Base::kPlane : Base::kNone;
}

}  // namespace

bool AddChain(TreeChain chain, LinkTree* tree) {
  const Base base = chain.from_world ? BaseOf(chain) : Base::kNone;
  if (chain.joints.empty() || base != Base::kNone) {
    TreeJoint joint{.name = chain.name, .parent = chain.parent, .child = chain.child};
    for (const TreeJoint& step : chain.joints) {
      joint.origin = Compose(joint.origin, Compose(step.origin, MotionOf(step, 0)));
    }
    joint.origin = Compose(joint.origin, chain.end);
    if (base != Base::kNone) {
      joint.type = TreeJoint::Type::kFloating;
      joint.origin.position.setZero();
      tree->base_in_plane = base == Base::kPlane;
    }
    tree->joints.push_back(joint);
    return base != Base::kNone;
  }
  int parent = chain.parent;
  for (size_t i = 0; i < chain.joints.size(); ++i) {
    TreeJoint& joint = chain.joints[i];
    const bool is_last = i + 1 == chain.joints.size();
    joint.parent = parent;
    joint.child = is_last ? chain.child : tree->AddLink({.name = joint.name + "_link", .is_made = true});
    if (is_last) joint.end = chain.end;
    parent = joint.child;
    tree->joints.push_back(std::move(joint));
  }
  return false;
}

}  // namespace rollgait::client
