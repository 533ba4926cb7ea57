#include "client/import/upright.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

namespace rollgait::client {
namespace {

bool HasWord(std::string name, std::initializer_list<const char*> words) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

// Mean origin of the joints whose own name, or whose child's, has one of the words.
std::optional<Eigen::Vector3d> MeanOf(const LinkTree& tree, const TreePosture& posture,
                                      std::initializer_list<const char*> words) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (size_t i = 0; i < tree.joints.size(); ++i) {
    const std::string& child = tree.links[static_cast<size_t>(tree.joints[i].child)].name;
    if (!HasWord(tree.joints[i].name, words) && !HasWord(child, words)) continue;
    sum += posture.joints[i];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace

std::optional<Eigen::Matrix3d> TurnUpright(const LinkTree& tree, const TreePosture& posture) {
  const auto hips = MeanOf(tree, posture, {"hip", "thigh", "femur"});
  auto feet = MeanOf(tree, posture, {"ankle", "foot", "toe"});
  if (!feet) feet = MeanOf(tree, posture, {"knee", "shank", "tibia", "shin", "calf"});
  if (!hips || !feet) return std::nullopt;
  constexpr double kAlong = 0.8;  // bent knees and feet ahead of hips leave the axis
  const Eigen::Vector3d down = *feet - *hips;
  int axis = 0;
  if (down.cwiseAbs().maxCoeff(&axis) < kAlong * down.norm() || down.norm() < 1e-3) return std::nullopt;
  const Eigen::Vector3d legs = std::copysign(1.0, down(axis)) * Eigen::Vector3d::Unit(axis);
  if (legs.z() < -0.5) return std::nullopt;
  // About x where the legs hang along y or stand on their head, so that x stays what it is.
  const Eigen::Vector3d about = axis == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const double angle = axis == 2 ? std::acos(-1.0) : std::asin(1.0) * (axis == 0 ? legs.x() : -legs.y());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, about).toRotationMatrix();
  return turn.array().round().matrix();
}

}  // namespace rollgait::client
