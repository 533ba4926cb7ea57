#ifndef ROLLGAIT_CORE_MODELS_JOINT_CHAIN_H_
#define ROLLGAIT_CORE_MODELS_JOINT_CHAIN_H_

#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "core/multibody/model.h"

namespace rollgait {

// Types of joints that messages say as one and that are a chain in the tree: revolute joints about axes through one
// point, with massless links between. Each has a constant twist in its link, so that derivatives stay exact, and
// dynamics knows nothing of the type.
struct ChainKind {
  const char* name;  // of the value of rollgait.v1.Joint.Type
  int turns;         // rollgait.v1.Joint.coordinates of it
};
inline constexpr ChainKind kChainKinds[] = {{"TYPE_UNIVERSAL", 2}, {"TYPE_BALL", 3}};

// By the name of the value of rollgait.v1.Joint.Type; null if none has it.
constexpr const ChainKind* FindChainKind(std::string_view name) {
  for (const ChainKind& kind : kChainKinds) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

// Fields of rollgait.v1.JointCoordinate, all of which rollgait.v1.Joint has, too.
inline constexpr const char* kCoordinateFields[] = {
    "name",       "axis",      "position_min",  "position_max", "velocity_max", "actuated", "effort_min",
    "effort_max", "stiffness", "rest_position", "damping",      "mirror_sign",  "role",     "passive"};

// One joint of the message: joints first … last of the tree. Their frames are those of the first at position zero.
struct JointChain {
  std::string name;
  const ChainKind* kind = nullptr;
  int first = 0;
  int last() const { return first + kind->turns - 1; }
};

// The message's index of the joint that joint `index` of the tree is, or is a part of. `chains`: ascending.
int MessageIndex(const std::vector<JointChain>& chains, int index);
// "joints[3].coordinates[1].axis", or "joints[2].axis" of a joint for itself.
std::string JointPath(const std::vector<JointChain>& chains, int index, const std::string& field);

// Consecutive axes are at least as far from parallel, rad.
inline constexpr double kLeastAxisAngle = 10 * std::numbers::pi / 180;
// How far the second of three turns may be from where the axes a1, a2, a3 span most, rad; cos 80° = 0.17 of that is
// left there. With a2 unit, a1 · (a2 × R(a2, q) a3) = A cos(q − center): zero at center ± π/2.
inline constexpr double kLargestMiddleTurn = 80 * std::numbers::pi / 180;

// What is wrong with the axes of a chain, and of which of its joints; empty: nothing. Contract: unit axes.
std::string AxesProblem(const JointChain& chain, const std::vector<Joint>& joints, int* joint);
// What is wrong with a range of positions (rad) of joint `index`; empty if it is not the second of three in one of the
// chains, or stays within ±kLargestMiddleTurn of a place where the axes span most. Contract: no AxesProblem.
std::string RangeProblem(const std::vector<JointChain>& chains, const std::vector<Joint>& joints, int index, double min,
                         double max);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_JOINT_CHAIN_H_
