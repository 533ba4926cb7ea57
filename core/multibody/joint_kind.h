#ifndef ROLLGAIT_CORE_MULTIBODY_JOINT_KIND_H_
#define ROLLGAIT_CORE_MULTIBODY_JOINT_KIND_H_

#include <cstddef>
#include <string_view>

namespace rollgait {

// kFree: six degrees of freedom. Its positions are the quaternion w, x, y, z (link -> joint frame; used as q/|q|) and
// the link's origin in the joint frame, m; its velocities the twist of the link relative to the parent at the link's
// origin in link axes, [angular rad/s; linear m/s]. A twist in link axes keeps the joint's motion subspace constant.
enum class JointType { kRevolute, kPrismatic, kFree, kScrew };

// What dynamics, checks, conversion and tables know of a type of joints. One with one degree of freedom moves its link
// along the unit axis u of the joint frame by a constant twist S = [turn · u; advance · u], angular first, at the
// link's origin, so that exp(q S) turns it by turn · q about u and moves it by advance · q along u. S is fixed in the
// link's axes: with that alone every derivative of dynamics and contacts is exact (docs/explanation/derivatives.md).
struct JointKind {
  JointType type;
  const char* name;  // of the value of rollgait.v1.Joint.Type, whose options tell clients the same as this row
  const char* word;  // as in a table or a sentence; the option joint_word
  int positions;     // numbers that it contributes to q
  int velocities;    // and to v
  bool turns;        // turn: 1 or 0. Positions are rad and efforts N m, or else m and N. The option joint_turns
  double advance;    // m per unit of the position; of joints that also turn, the part that no joint changes
  bool is_slide() const { return velocities == 1 && !turns; }
  bool is_free() const { return velocities > 1; }
  const char* unit() const { return turns ? "rad" : "m"; }
  const char* effort_unit() const { return turns ? "N m" : "N"; }
};

// In the order of the enumeration.
inline constexpr JointKind kJointKinds[] = {
    {JointType::kRevolute, "TYPE_REVOLUTE", "revolute", 1, 1, true, 0},
    {JointType::kPrismatic, "TYPE_PRISMATIC", "prismatic", 1, 1, false, 1},
    {JointType::kFree, "TYPE_FREE", "free", 7, 6, false, 0},
    {JointType::kScrew, "TYPE_SCREW", "screw", 1, 1, true, 0},
};

constexpr const JointKind& KindOf(JointType type) { return kJointKinds[static_cast<size_t>(type)]; }

// By the name of the value of rollgait.v1.Joint.Type; null if none has it.
constexpr const JointKind* FindJointKind(std::string_view name) {
  for (const JointKind& kind : kJointKinds) {
    if (name == kind.name) return &kind;
  }
  return nullptr;
}

// Numbers that a joint contributes to q and to v.
constexpr int PositionCount(JointType type) { return KindOf(type).positions; }
constexpr int VelocityCount(JointType type) { return KindOf(type).velocities; }

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_JOINT_KIND_H_
