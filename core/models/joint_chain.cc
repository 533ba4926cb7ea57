#include "core/models/joint_chain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>

namespace rollgait {
namespace {

constexpr double kRounding = 1e-6;  // rad, of ranges that were given in degrees

// The chain that joint `index` is a part of, or null.
const JointChain* ChainOf(const std::vector<JointChain>& chains, int index) {
  const auto found = std::find_if(chains.begin(), chains.end(), [index](const JointChain& chain) {
    return chain.first <= index && index <= chain.last();
  });
  return found == chains.end() ? nullptr : &*found;
}

// Where the three axes span most: a1 · (a2 × R(a2, q) a3) = a1 · (a2 × a3) cos q − a1 · a3⊥ sin q, with a3⊥ the part of
// a3 that is perpendicular to a2.
double Center(const JointChain& chain, const std::vector<Joint>& joints) {
  const Vector3 &a1 = joints[chain.first].axis, &a2 = joints[chain.first + 1].axis, &a3 = joints[chain.first + 2].axis;
  return -std::atan2(a1.dot(a3 - a2.dot(a3) * a2), a1.dot(a2.cross(a3)));
}

}  // namespace

int MessageIndex(const std::vector<JointChain>& chains, int index) {
  int before = 0;  // joints of the tree that the message does not have
  for (const JointChain& chain : chains) before += std::clamp(index - chain.first, 0, chain.kind->turns - 1);
  return index - before;
}

std::string JointPath(const std::vector<JointChain>& chains, int index, const std::string& field) {
  std::string path = "joints[" + std::to_string(MessageIndex(chains, index)) + "].";
  const JointChain* const chain = ChainOf(chains, index);
  if (chain == nullptr) return path + field;
  const std::string coordinate = "coordinates[" + std::to_string(index - chain->first) + "].";
  // Links between are called after their coordinates.
  if (field == "link_name" && index != chain->last()) return path + coordinate + "name";
  const bool is_own =
      std::find(std::begin(kCoordinateFields), std::end(kCoordinateFields), field) != std::end(kCoordinateFields);
  return path + (is_own ? coordinate : "") + field;
}

std::string AxesProblem(const JointChain& chain, const std::vector<Joint>& joints, int* joint) {
  for (int i = chain.first + 1; i <= chain.last(); ++i) {
    const double sine = joints[i].axis.cross(joints[i - 1].axis).norm();
    if (sine >= std::sin(kLeastAxisAngle)) continue;
    *joint = i;
    std::ostringstream text;
    text << "is (" << joints[i].axis.transpose() << "), " << std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi
         << "° from the line of the axis before it; must be at least " << kLeastAxisAngle * 180 / std::numbers::pi
         << "°, since two turns about parallel axes are one";
    return text.str();
  }
  return "";
}

std::string RangeProblem(const std::vector<JointChain>& chains, const std::vector<Joint>& joints, int index, double min,
                         double max) {
  const JointChain* const chain = ChainOf(chains, index);
  if (chain == nullptr || chain->kind->turns != 3 || index != chain->first + 1) return "";
  double center = Center(*chain, joints);
  if (const double middle = (min + max) / 2; std::isfinite(middle)) {
    center += std::numbers::pi * std::round((middle - center) / std::numbers::pi);
  }
  const double least = center - kLargestMiddleTurn, most = center + kLargestMiddleTurn;
  if (min >= least - kRounding && max <= most + kRounding) return "";
  std::ostringstream text;
  text << "is " << min << " to " << max << " rad; the second coordinate of a ball joint must stay within " << least
       << " to " << most << " rad: at " << center - std::numbers::pi / 2 << " and " << center + std::numbers::pi / 2
       << " rad the joint loses a direction. Order its axes so that the second turns least";
  return text.str();
}

}  // namespace rollgait
