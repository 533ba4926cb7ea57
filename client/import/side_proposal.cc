#include "client/import/side_proposal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "client/failure.h"
#include "client/import/foot_fit.h"
#include "client/import/limb_roles.h"
#include "client/import/mirror_average.h"
#include "client/import/mirror_images.h"
#include "client/import/mirror_names.h"
#include "client/import/tree_model.h"
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
    Place(0);
    TurnToLeft();
    FindLegs();
    SetRoles();
    for (const auto& [side, chain] : legs_) AddFoot(side, chain);
    LockUnlimited();
    AddJoints();
    AddFeetPair();
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

  bool IsSideways(int i) const {
    const double across = std::abs(upright_.axes[static_cast<size_t>(i)].y());
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
      const bool sideways = tree_.base_in_plane && IsSideways(static_cast<int>(i));
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

  void Place(double yaw) {
    const Pose root{Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix(), Eigen::Vector3d::Zero()};
    posture_ = PostureOf(tree_, root, positions_, locked_);
  }

  // Of a joint: by its name, the name of its link, else by where its link is.
  v1::BodySide SideOf(int joint) const {
    const auto child = static_cast<size_t>(Joint(joint).child);
    for (const std::string& name : {Joint(joint).name, tree_.links[child].name}) {
      if (MirrorNameOf(name).side != v1::BODY_SIDE_UNSPECIFIED) return MirrorNameOf(name).side;
    }
    const double y = posture_.links[child].position.y();
    return y > 0.01 ? v1::BODY_SIDE_LEFT : y < -0.01 ? v1::BODY_SIDE_RIGHT : v1::BODY_SIDE_UNSPECIFIED;
  }

  double Lowest(int joint) const {
    const std::vector<int> links = LinksMovedBy(posture_, joint);
    if (const auto extent = ExtentOf(tree_, posture_, links)) return extent->least.z();
    double lowest = std::numeric_limits<double>::infinity();
    for (const int link : links) lowest = std::min(lowest, posture_.links[static_cast<size_t>(link)].position.z());
    return lowest;
  }

  // The last joint of the chain that reaches lowest; -1 if the side has none.
  int LegEnd(v1::BodySide side) const {
    int end = -1;
    for (int i = 0; i < static_cast<int>(tree_.joints.size()); ++i) {
      if (!Joint(i).Moves() || locked_[static_cast<size_t>(i)] || SideOf(i) != side) continue;
      const bool is_last = std::none_of(tree_.joints.begin(), tree_.joints.end(), [&](const TreeJoint& other) {
        const int index = static_cast<int>(&other - tree_.joints.data());
        return other.Moves() && !locked_[static_cast<size_t>(index)] &&
               posture_.behind[static_cast<size_t>(index)] == i;
      });
      if (is_last && (end < 0 || Lowest(i) < Lowest(end))) end = i;
    }
    return end;
  }

  // The chain to the end, without what also carries the other leg.
  std::vector<int> LegTo(int end, int other) const {
    const std::vector<int> shared = other < 0 ? std::vector<int>() : ChainTo(posture_, other);
    std::vector<int> leg = ChainTo(posture_, end);
    leg.erase(std::remove_if(leg.begin(), leg.end(),
                             [&](int i) { return std::find(shared.begin(), shared.end(), i) != shared.end(); }),
              leg.end());
    return leg;
  }
  void FindLegs() {
    const int ends[] = {LegEnd(kSides[0]), LegEnd(kSides[1])};
    for (const int k : {0, 1}) {
      if (ends[k] < 0) continue;
      legs_.emplace(kSides[k], LegTo(ends[k], ends[1 - k]));
      // What carries both legs flexes no trunk above the base.
      for (const int i : ChainTo(posture_, ends[k])) carries_leg_[static_cast<size_t>(i)] = true;
    }
  }

  // Turns the root about z until the left leg is in +y of the right one.
  void TurnToLeft() {
    const int left = LegEnd(v1::BODY_SIDE_LEFT), right = LegEnd(v1::BODY_SIDE_RIGHT);
    if (left < 0 || right < 0) return;
    const auto hip = [&](int end, int other) {
      return posture_.joints[static_cast<size_t>(LegTo(end, other).front())];
    };
    Eigen::Vector3d to_left = hip(left, right) - hip(right, left);
    if (to_left.head<2>().norm() < 1e-3) {  // hips in one place: by the feet
      to_left = posture_.links[static_cast<size_t>(Joint(left).child)].position -
                posture_.links[static_cast<size_t>(Joint(right).child)].position;
    }
    const double yaw = kPi / 2 - std::atan2(to_left.y(), to_left.x());
    if (to_left.head<2>().norm() < 1e-3 || std::abs(std::remainder(yaw, 2 * kPi)) < 1e-3) return;
    const double turn = std::remainder(yaw, 2 * kPi);
    v1::Quaternion& q = *proposal_.side.mutable_base_orientation();
    q.set_w(std::cos(turn / 2));
    q.set_z(std::sin(turn / 2));
    proposal_.reasons.push_back("the root is turned by " + FormatNumber(turn * 180 / kPi) +
                                "° about z: the left leg is then in +y, and x is forward");
    Place(turn);
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

  void AddFoot(v1::BodySide side, const std::vector<int>& chain) {
    const int link = Joint(chain.back()).child;
    const std::string name = std::string(SideWord(side)) + "_foot",
                      link_name = tree_.links[static_cast<size_t>(link)].name;
    const auto extent = ExtentOf(tree_, posture_, LinksMovedBy(posture_, chain.back()));
    if (!extent) {
      proposal_.missing.push_back(
          "contact \"" + name + "\": link \"" + link_name +
          "\" has no box, sphere, cylinder, capsule or ellipsoid as shape; add an ellipsoid from heel to toe");
      return;
    }
    const Pose& place = posture_.links[static_cast<size_t>(link)];
    double leg = posture_.joints[static_cast<size_t>(chain.front())].z() - extent->least.z();
    for (const int i : chain) {
      const auto found = roles_.find(i);
      if (found == roles_.end() || found->second != v1::Joint::ROLE_HIP_FLEXION) continue;
      leg = posture_.joints[static_cast<size_t>(i)].z() - extent->least.z();
    }
    if (!(leg > 0.01)) {
      proposal_.missing.push_back("contact \"" + name + "\": link \"" + link_name +
                                  "\" is not below the hip; set the references");
      return;
    }
    const FittedEllipsoid foot = FitFoot(*extent, leg);
    v1::SideContact& contact = *proposal_.side.add_contacts();
    contact.set_name(name);
    contact.set_link(link_name);
    contact.set_side(side);
    contact.set_part(v1::ContactSurface::FOOT_PART_WHOLE);
    SetVector(foot.semi_axes, contact.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m());
    SetVector(place.rotation.transpose() * (foot.center - place.position), contact.mutable_center_m());
    if (const Eigen::Matrix3d to_link = place.rotation.transpose(); !to_link.isIdentity(1e-12)) {
      const Eigen::Quaterniond q(to_link);
      v1::Quaternion& to = *contact.mutable_orientation();
      to.set_w(q.w());
      to.set_x(q.x());
      to.set_y(q.y());
      to.set_z(q.z());
    }
    proposal_.reasons.push_back("contact \"" + name + "\": an ellipsoid as long and broad as the shapes of \"" +
                                link_name + "\", sole radius " +
                                FormatNumber(foot.semi_axes.x() * foot.semi_axes.x() / foot.semi_axes.z()) + " m");
  }

  static void SetVector(const Eigen::Vector3d& from, v1::Vector3* to) {
    const auto rounded = [](double value) { return std::round(value * 1e12) / 1e12 + 0.0; };
    to->set_x(rounded(from.x()));
    to->set_y(rounded(from.y()));
    to->set_z(rounded(from.z()));
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

  // Feet do not pass through each other.
  void AddFeetPair() {
    if (proposal_.side.contacts_size() != 2) return;
    // Equal to the bit, as mirror images must be.
    const Eigen::Vector3d first = ToVector(proposal_.side.contacts(0).surface().ellipsoid().semi_axes_m());
    v1::Vector3& second =
        *proposal_.side.mutable_contacts(1)->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
    if ((first - ToVector(second)).norm() < 1e-5) SetVector(first, &second);
    for (const v1::SideContact& contact : proposal_.side.contacts()) {
      v1::SideBody& body = *proposal_.side.add_bodies();
      body.set_name(contact.name());
      body.set_link(contact.link());
      *body.mutable_surface() = contact.surface();
      *body.mutable_center_m() = contact.center_m();
      if (contact.has_orientation()) *body.mutable_orientation() = contact.orientation();
    }
    v1::BodyPair& pair = *proposal_.side.add_body_pairs();
    pair.set_first(proposal_.side.contacts(0).name());
    pair.set_second(proposal_.side.contacts(1).name());
    pair.set_usual(true);
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
  TreePosture posture_, upright_;                  // upright: every joint at zero, the root not turned
  std::map<v1::BodySide, std::vector<int>> legs_;  // joints from the hip to the foot
  std::map<int, v1::Joint::Role> roles_;
  SideProposal proposal_;
};

}  // namespace

SideProposal ProposeSideFile(const LinkTree& tree) { return Proposer(tree).Propose(); }

}  // namespace rollgait::client
