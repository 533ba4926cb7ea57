#include "client/import/side_proposal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "client/failure.h"
#include "client/import/foot_proposal.h"
#include "client/import/leg_chains.h"
#include "client/import/limb_roles.h"
#include "client/import/mirror_average.h"
#include "client/import/mirror_images.h"
#include "client/import/mirror_names.h"
#include "client/import/tree_model.h"
#include "client/import/upright.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

const char* SideWord(v1::BodySide side) { return side == v1::BODY_SIDE_LEFT ? "left" : "right"; }
constexpr v1::BodySide kSides[] = {v1::BODY_SIDE_LEFT, v1::BODY_SIDE_RIGHT};

class Proposer {
 public:
  explicit Proposer(const LinkTree& tree)
      : tree_(tree), locked_(tree.joints.size(), false), carries_leg_(tree.joints.size(), false) {}

  SideProposal Propose() {
    if (const std::string name = AsModelName(tree_.name); name != tree_.name) {
      proposal_.side.set_name(name);
      proposal_.reasons.push_back("name \"" + name +
                                  "\": models have letters, digits, \"_\", \"-\" and \".\" in theirs");
    }
    LockJoints();
    Place();
    StandUpright();
    TurnToLeft();
    StayInPlane();
    FindLegs();
    SetRoles();
    for (const auto& [side, chain] : legs_) AddFoot(side, chain);
    LockUnlimited();
    AddJoints();
    AddFeetPairs(&proposal_.side);
    CheckMirror();
    for (const v1::BodySide side : kSides) {
      if (legs_.count(side) == 0) {
        proposal_.missing.push_back(std::string("no leg found on the ") + SideWord(side) +
                                    " side: give its joints roles and sides, and its foot a contact");
      }
    }
    return std::move(proposal_);
  }

 private:
  const TreeJoint& Joint(int i) const { return tree_.joints[static_cast<size_t>(i)]; }

  bool IsSideways(const TreePosture& posture, int i) const {
    const double across = std::abs(posture.axes[static_cast<size_t>(i)].y());
    return Joint(i).type == TreeJoint::Type::kPrismatic ? across > 1e-6 : across < 1 - 1e-6;
  }

  void LockJoints() {
    upright_ = PostureOf(tree_, kNoMotion, {}, locked_);
    if (tree_.base_in_plane) {
      proposal_.side.set_base(v1::ModelSideFile::BASE_PLANE);
      proposal_.reasons.push_back("base BASE_PLANE: the base of the file moves in the plane");
    }
    const std::vector<bool> moves_none = JointsWithoutMass(tree_);
    for (size_t i = 0; i < tree_.joints.size(); ++i) {
      const TreeJoint& joint = tree_.joints[i];
      const bool planar = joint.type == TreeJoint::Type::kPlanar;
      if (!planar && !joint.Moves()) continue;
      // The base moves in the plane: so does everything else.
      const bool sideways = tree_.base_in_plane && IsSideways(upright_, static_cast<int>(i));
      locked_[i] = planar || !joint.mimics.empty() || moves_none[i] || sideways;
      if (locked_[i]) {
        proposal_.reasons.push_back("joint \"" + joint.name + "\" is locked: it " +
                                    (planar                  ? "is planar"
                                     : !joint.mimics.empty() ? "mimics \"" + joint.mimics + "\""
                                     : sideways              ? "moves out of the plane of the base"
                                                             : "moves no mass"));
      }
      const bool bounded = joint.type == TreeJoint::Type::kRevolute || joint.type == TreeJoint::Type::kPrismatic;
      if (!bounded || (joint.lower <= 0 && joint.upper >= 0)) continue;
      positions_[joint.name] = joint.lower > 0 ? joint.lower : joint.upper;
      proposal_.reasons.push_back("reference of joint \"" + joint.name +
                                  "\": the end of its range that is nearest to 0");
    }
  }

  void Place() { posture_ = PostureOf(tree_, {turn_, Eigen::Vector3d::Zero()}, positions_, locked_); }

  // Turns the root by one more rotation in the world.
  void Turn(const Eigen::Matrix3d& rotation) {
    turn_ = rotation * turn_;
    const Eigen::Quaterniond q(turn_);
    v1::Quaternion& to = *proposal_.side.mutable_base_orientation();
    to.set_w(q.w());
    to.set_x(q.x());
    to.set_y(q.y());
    to.set_z(q.z());
    Place();
  }

  void StandUpright() {
    const auto turn = TurnUpright(tree_, posture_);
    if (!turn) return;
    Turn(*turn);
    const Eigen::AngleAxisd by(*turn);
    proposal_.reasons.push_back("the root is turned by " + FormatNumber(by.angle() * 180 / kPi) + "° about (" +
                                FormatNumber(by.axis().x()) + ", " + FormatNumber(by.axis().y()) +
                                ", 0): the legs hang then along −z");
  }

  // A body without a joint that moves it sideways cannot keep its balance sideways.
  void StayInPlane() {
    if (tree_.base_in_plane) return;
    bool moves = false;
    for (int i = 0; i < static_cast<int>(tree_.joints.size()); ++i) {
      if (!Joint(i).Moves() || locked_[static_cast<size_t>(i)]) continue;
      if (IsSideways(posture_, i)) return;
      moves = true;
    }
    if (!moves) return;
    proposal_.side.set_base(v1::ModelSideFile::BASE_PLANE);
    proposal_.reasons.push_back("base BASE_PLANE: no joint moves out of the plane of x and z");
  }

  void FindLegs() {
    const int ends[] = {LegEnd(tree_, posture_, locked_, kSides[0]), LegEnd(tree_, posture_, locked_, kSides[1])};
    for (const int k : {0, 1}) {
      if (ends[k] < 0) continue;
      legs_.emplace(kSides[k], LegTo(posture_, ends[k], ends[1 - k]));
      // What carries both legs flexes no trunk above the base.
      for (const int i : ChainTo(posture_, ends[k])) carries_leg_[static_cast<size_t>(i)] = true;
    }
  }

  // Turns the root about z until the left leg is in +y of the right one.
  void TurnToLeft() {
    const int left = LegEnd(tree_, posture_, locked_, v1::BODY_SIDE_LEFT),
              right = LegEnd(tree_, posture_, locked_, v1::BODY_SIDE_RIGHT);
    if (left < 0 || right < 0) return;
    const auto hip = [&](int end, int other) {
      return posture_.joints[static_cast<size_t>(LegTo(posture_, end, other).front())];
    };
    Eigen::Vector3d to_left = hip(left, right) - hip(right, left);
    if (to_left.head<2>().norm() < 1e-3) {  // hips in one place: by the feet
      to_left = posture_.links[static_cast<size_t>(Joint(left).child)].position -
                posture_.links[static_cast<size_t>(Joint(right).child)].position;
    }
    if (to_left.head<2>().norm() < 1e-3)
      to_left = LeftOfKnees(tree_, posture_, LegTo(posture_, left, right));  // drawn in a plane
    const double yaw = kPi / 2 - std::atan2(to_left.y(), to_left.x());
    if (to_left.head<2>().norm() < 1e-3 || std::abs(std::remainder(yaw, 2 * kPi)) < 1e-3) return;
    const double turn = std::remainder(yaw, 2 * kPi);
    Turn(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    proposal_.reasons.push_back("the root is turned by " + FormatNumber(turn * 180 / kPi) +
                                "° about z: the left leg is then in +y, and x is forward");
  }

  void SetRoles() {
    std::vector<LimbJoint> limbs;
    for (const auto& [side, chain] : legs_) {
      for (const int i : chain) limbs.push_back({i, Joint(i).name, side, true, AcrossOf(i)});
    }
    std::vector<LimbJoint> others;
    for (int i = 0; i < static_cast<int>(tree_.joints.size()); ++i) {
      if (!Joint(i).Moves() || locked_[static_cast<size_t>(i)] || carries_leg_[static_cast<size_t>(i)]) continue;
      others.push_back({i, Joint(i).name, MirrorNameOf(Joint(i).name).side, false, AcrossOf(i)});
    }
    limbs.insert(limbs.end(), others.begin(), others.end());
    for (const LimbRole& role : ProposeRoles(limbs)) {
      roles_.emplace(role.index, role.role);
      proposal_.reasons.push_back("joint \"" + Joint(role.index).name + "\" is " + v1::Joint::Role_Name(role.role) +
                                  ": " + role.reason);
    }
  }

  // How far a joint turns about y of the world, 0 to 1; 0 of a prismatic one.
  double AcrossOf(int i) const {
    return Joint(i).type == TreeJoint::Type::kPrismatic ? 0 : std::abs(posture_.axes[static_cast<size_t>(i)].y());
  }

  // From the hip to the lowest of what the leg's last joint moves, m.
  double LegLength(const std::vector<int>& chain, const Extent& foot) const {
    double leg = posture_.joints[static_cast<size_t>(chain.front())].z() - foot.least.z();
    for (const int i : chain) {
      const auto found = roles_.find(i);
      if (found == roles_.end() || found->second != v1::Joint::ROLE_HIP_FLEXION) continue;
      leg = posture_.joints[static_cast<size_t>(i)].z() - foot.least.z();
    }
    return leg;
  }

  const std::string& LinkOf(int joint) const { return tree_.links[static_cast<size_t>(Joint(joint).child)].name; }

  void AddFoot(v1::BodySide side, const std::vector<int>& chain) {
    const std::string foot = std::string(SideWord(side)) + "_foot", link = LinkOf(chain.back());
    const auto extent = ExtentOf(tree_, posture_, LinksMovedBy(posture_, chain.back()));
    if (!extent) {
      proposal_.missing.push_back(
          "contact \"" + foot + "\": link \"" + link +
          "\" has no box, sphere, cylinder, capsule or ellipsoid as shape; add an ellipsoid from heel to toe");
      return;
    }
    const double leg = LegLength(chain, *extent);
    if (!(leg > 0.01)) {
      proposal_.missing.push_back("contact \"" + foot + "\": link \"" + link +
                                  "\" is not below the hip; set the references");
      return;
    }
    for (const StandingPart& standing : StandingParts(tree_, posture_, chain, leg)) {
      const std::string name = standing.part == v1::ContactSurface::FOOT_PART_WHOLE ? foot
                               : standing.part == v1::ContactSurface::FOOT_PART_HEEL
                                   ? SideWord(side) + std::string("_heel")
                                   : SideWord(side) + std::string("_toes");
      const FittedEllipsoid fitted = FitFoot(standing.extent, leg);
      const auto child = static_cast<size_t>(Joint(standing.joint).child);
      v1::SideContact& contact = *proposal_.side.add_contacts();
      contact = ContactOf(name, tree_.links[child].name, posture_.links[child], fitted);
      contact.set_side(side);
      contact.set_part(standing.part);
      const double radius = fitted.semi_axes.x() * fitted.semi_axes.x() / fitted.semi_axes.z();
      proposal_.reasons.push_back("contact \"" + name + "\": an ellipsoid as long and broad as the shapes of \"" +
                                  contact.link() + "\", sole radius " + FormatNumber(radius) + " m");
    }
  }

  bool LacksLimits(const TreeJoint& joint) const {
    const bool any_velocity = joint.velocity > 0 || !tree_.states_velocity;
    return joint.driven && !(joint.effort_min < 0 && joint.effort_max > 0 && any_velocity);
  }

  // A sensor that turns, a gripper: what has no limits and is of no limb.
  void LockUnlimited() {
    for (int i = 0; i < static_cast<int>(tree_.joints.size()); ++i) {
      const TreeJoint& joint = Joint(i);
      if (!joint.Moves() || locked_[static_cast<size_t>(i)] || carries_leg_[static_cast<size_t>(i)]) continue;
      if (roles_.count(i) != 0 || !LacksLimits(joint)) continue;
      locked_[static_cast<size_t>(i)] = true;
      proposal_.reasons.push_back("joint \"" + joint.name +
                                  "\" is locked: it has no limit of effort or velocity and is in no leg");
    }
  }

  void AddJoints() {
    for (int i = 0; i < static_cast<int>(tree_.joints.size()); ++i) {
      const TreeJoint& joint = Joint(i);
      const bool locked = locked_[static_cast<size_t>(i)];
      if (!joint.Moves() && !locked) continue;
      v1::SideJoint& to = *proposal_.side.add_joints();
      to.set_name(joint.name);
      if (positions_.count(joint.name) != 0) to.set_reference(positions_.at(joint.name));
      to.set_locked(locked);
      if (locked) continue;
      if (const auto role = roles_.find(i); role != roles_.end()) to.set_role(role->second);
      for (const auto& [side, chain] : legs_) {
        if (std::find(chain.begin(), chain.end(), i) != chain.end()) to.set_side(side);
      }
      if (to.side() == v1::BODY_SIDE_UNSPECIFIED) to.set_side(MirrorNameOf(joint.name).side);
      if (to.role() == v1::Joint::ROLE_TRUNK_FLEXION) to.set_side(v1::BODY_SIDE_UNSPECIFIED);
      if (LacksLimits(joint)) {
        proposal_.missing.push_back("joint \"" + joint.name +
                                    "\" has no limit of effort or velocity: give effortMin, effortMax and "
                                    "velocityMax, or \"actuated\": false");
      }
    }
  }

  void CheckMirror() {
    if (!proposal_.missing.empty() || legs_.size() != 2) return;
    v1::Model model;
    try {
      model = ModelOfTree(tree_, "the side file", proposal_.side).model;
    } catch (const Failure& failure) {
      proposal_.missing.push_back(failure.what());
      return;
    }
    const std::string difference = MirrorDifference(model);
    if (difference.empty()) return;
    const MirrorChange change = AverageMirrorImages(&model);
    const std::string left = MirrorDifference(model);
    if (change.IsSmall() && left.empty()) {
      proposal_.side.set_mirror(v1::ModelSideFile::MIRROR_AVERAGED);
      proposal_.reasons.push_back("left and right differ little and are averaged (" + change.Describe() +
                                  "), so that a step and its mirror image make the gait: " + difference);
    } else {
      proposal_.side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
      proposal_.reasons.push_back(
          "left and right differ, so the body walks in full cycles (--cycle full): " + difference +
          "; MIRROR_AVERAGED would change " + change.Describe() + (left.empty() ? "" : " and leave different " + left));
    }
  }

  const LinkTree& tree_;
  std::vector<bool> locked_, carries_leg_;
  std::map<std::string, double> positions_;
  TreePosture posture_, upright_;                       // upright: every joint at zero, the root not turned
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();  // of the root
  std::map<v1::BodySide, std::vector<int>> legs_;       // joints from the hip to the foot
  std::map<int, v1::Joint::Role> roles_;
  SideProposal proposal_;
};

}  // namespace

SideProposal ProposeSideFile(const LinkTree& tree) { return Proposer(tree).Propose(); }

}  // namespace rollgait::client
