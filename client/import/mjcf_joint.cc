#include "client/import/mjcf_joint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "client/text.h"

namespace rollgait::client {
namespace {

void Omit(const MjcfElement& joint, LeftOut* left_out) {
  constexpr std::pair<const char*, const char*> kReasons[] = {
      {"armature", "armature: links have the inertia of their masses only"},
      {"frictionloss", "frictionloss: joints of a model have no dry friction"}};
  for (const auto& [attribute, reason] : kReasons) {
    if (joint.Number(attribute, 0) != 0) left_out->Add(joint.xml(), reason);
  }
  if (joint.Has("springdamper")) left_out->Add(joint.xml(), "springdamper: give stiffness and damping");
}

constexpr int kTurnOrder[] = {1, 0, 2};
// Of the second turn: at 90° the other two turn about the same line. 80° is what rollgait.v1.JointCoordinate allows.
constexpr double kMostMiddleTurn = 80 * kPi / 180;

}  // namespace

std::string MjcfJointType(const MjcfElement& joint) {
  std::string type = joint.Has("type") ? joint.Get("type") : "hinge";
  if (type != "free" && type != "ball" && type != "hinge" && type != "slide") {
    joint.Refuse("type \"" + type.substr(0, 40) + "\" is unknown; must be free, ball, slide or hinge");
  }
  return type;
}

TreeJoint ReadMjcfJoint(const MjcfElement& from, LeftOut* left_out) {
  const bool turns = MjcfJointType(from) == "hinge";
  const auto angle = [&](double value) { return turns ? from.compiler().Angle(value) : value; };
  const bool limited = from.IsLimited("limited", "range");
  TreeJoint joint;
  joint.type = !turns    ? TreeJoint::Type::kPrismatic
               : limited ? TreeJoint::Type::kRevolute
                         : TreeJoint::Type::kContinuous;
  joint.origin.position = from.Vector("pos", Eigen::Vector3d::Zero());
  joint.axis = from.Vector("axis", Eigen::Vector3d::UnitZ());
  joint.zero = angle(from.Number("ref", 0));
  joint.lower = -std::numeric_limits<double>::infinity();
  joint.upper = std::numeric_limits<double>::infinity();
  if (limited) {
    const std::vector<double> range = from.Numbers("range", 2, 2);
    if (range.empty()) from.Refuse("is limited, but has no range");
    joint.lower = angle(range[0]);
    joint.upper = angle(range[1]);
  }
  joint.stiffness = from.Number("stiffness", 0);
  joint.rest = angle(from.Number("springref", 0));
  joint.damping = from.Number("damping", 0);
  Omit(from, left_out);
  return joint;
}

std::string MjcfTurnName(const std::string& ball, int axis) { return ball + "_" + "xyz"[axis]; }

std::vector<TreeJoint> ReadMjcfBall(const MjcfElement& from, const std::string& name, LeftOut* left_out) {
  double most = std::numeric_limits<double>::infinity();
  if (from.IsLimited("limited", "range")) {
    const std::vector<double> range = from.Numbers("range", 2, 2);
    if (range.empty()) from.Refuse("is limited, but has no range");
    most = from.compiler().Angle(range[1]);
    if (!(range[0] == 0 && most > 0)) {
      from.Refuse("its range must begin at 0 and end above: it is that of the angle by which a ball joint turns");
    }
  }
  std::vector<TreeJoint> turns;
  for (const int axis : kTurnOrder) {
    TreeJoint& turn = turns.emplace_back();
    const double reach = turns.size() == 2 ? std::min(most, kMostMiddleTurn) : most;
    turn.name = MjcfTurnName(name, axis);
    turn.turn_of = name;
    turn.type = std::isinf(reach) ? TreeJoint::Type::kContinuous : TreeJoint::Type::kRevolute;
    turn.axis = Eigen::Vector3d::Unit(axis);
    turn.lower = -reach;
    turn.upper = reach;
    turn.stiffness = from.Number("stiffness", 0);
    turn.damping = from.Number("damping", 0);
  }
  if (turns[0].stiffness != 0 || turns[0].damping != 0) {
    left_out->Add(
        from.xml(),
        "spring and damper of a ball joint act on the angles of its three turns, which for large ones differs "
        "from MuJoCo's");
  }
  Omit(from, left_out);
  return turns;
}

}  // namespace rollgait::client
