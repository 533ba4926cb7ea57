#include "core/models/human.h"

#include <numbers>
#include <utility>

#include "core/base/check.h"
#include "core/models/joint_limits.h"
#include "core/models/limb_bodies.h"
#include "core/models/passive_torque.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// What is told of joints by their names without side.
struct JointKind {
  const char* name;
  JointRole role;
  PassiveKind passive;
};
constexpr JointKind kJointKinds[] = {
    {"base_x", JointRole::kBaseForward, PassiveKind::kNone},
    {"base_y", JointRole::kBaseLateral, PassiveKind::kNone},
    {"base_z", JointRole::kBaseVertical, PassiveKind::kNone},
    {"base_yaw", JointRole::kBaseYaw, PassiveKind::kNone},
    {"base_roll", JointRole::kBaseRoll, PassiveKind::kNone},
    {"base_pitch", JointRole::kBasePitch, PassiveKind::kNone},
    {"hip", JointRole::kHipFlexion, PassiveKind::kHumanHip},
    {"knee", JointRole::kKneeFlexion, PassiveKind::kHumanKnee},
    {"ankle", JointRole::kAnkleDorsiflexion, PassiveKind::kHumanAnkle},
    {"trunk_flexion", JointRole::kTrunkFlexion, PassiveKind::kStops},
    {"shoulder", JointRole::kShoulderFlexion, PassiveKind::kStops},
    {"elbow", JointRole::kElbowFlexion, PassiveKind::kStops},
};
constexpr JointKind kOtherJoint = {"", JointRole::kNone, PassiveKind::kStops};

const JointKind& KindOf(const std::string& name) {
  for (const JointKind& kind : kJointKinds) {
    if (name == kind.name) return kind;
  }
  return kOtherJoint;
}

const char* Suffix(BodySide side) { return side == BodySide::kLeft ? "_l" : side == BodySide::kRight ? "_r" : ""; }

class HumanBuilder {
 public:
  HumanBuilder(const SegmentTable& left, const SegmentTable& right, const HumanOptions& options)
      : table_(left), right_(right), options_(options) {}

  HumanBody Build() {
    AddBase();
    AddLeg(BodySide::kLeft);
    AddLeg(BodySide::kRight);
    AddTrunk();
    AddArm(BodySide::kLeft);
    AddArm(BodySide::kRight);
    PairJoints();
    Result<Model> model = Model::Create(std::move(joints_));
    ROLLGAIT_CHECK(model.ok());
    const int half = static_cast<int>(contacts_.size()) / 2;
    for (int c = 0; c < 2 * half; ++c) contacts_[c].mirror_contact = (c + half) % (2 * half);
    HumanBody human{std::move(model).value(), std::move(contacts_), {}, {}};
    for (LimbSurface& limb : limbs_) {
      for (size_t k = 0; k < limbs_.size(); ++k) {
        if (limbs_[k].body.name == MirrorName(limb.body.name)) limb.body.mirror_body = static_cast<int>(k);
      }
      human.bodies.push_back(limb.body);
    }
    human.pairs = LimbPairs(limbs_);
    return human;
  }

 private:
  // A segment on the link that carries it.
  RigidBody OnLink(Segment segment, BodySide side) const {
    const SegmentTable& table = Of(side);
    return Shifted(table.Body(segment, side), PlaceOf(segment, side, table).origin);
  }

  const SegmentTable& Of(BodySide side) const { return side == BodySide::kRight ? right_ : table_; }

  static std::string Sided(BodySide side, const std::string& name) {
    return (side == BodySide::kLeft ? "left_" : "right_") + name;
  }
  static std::string MirrorName(const std::string& name) {
    return name.starts_with("left_") ? "right_" + name.substr(5) : "left_" + name.substr(6);
  }

  // Appends a joint, by its name without side; returns its index. Its link has no mass yet.
  int Add(const std::string& kind, BodySide side, JointType type, int parent, const Vector3& origin,
          const Vector3& axis) {
    const std::string name = kind + Suffix(side);
    Joint joint;
    joint.name = name;
    joint.role = KindOf(kind).role;
    joint.passive = KindOf(kind).passive;
    joint.side = side;
    joint.type = type;
    joint.parent = parent;
    joint.p_PJ = origin;
    joint.axis = axis;
    joint.link = name + "_link";
    joints_.push_back(joint);
    return static_cast<int>(joints_.size()) - 1;
  }

  const JointLimits& SetRange(const std::string& name, Joint* joint) const {
    const JointLimits& limits = LimitsOf(name);
    const bool walking = options_.ranges == JointRanges::kWalking;
    joint->position_min = (walking ? limits.walking_min : limits.position_min) * kDegree;
    joint->position_max = (walking ? limits.walking_max : limits.position_max) * kDegree;
    return limits;
  }

  // Appends an actuated joint with its limits.
  int AddActuated(const std::string& name, BodySide side, int parent, const Vector3& origin, const Vector3& axis) {
    const int index = Add(name, side, JointType::kRevolute, parent, origin, axis);
    const JointLimits& limits = SetRange(name, &joints_[index]);
    Joint& joint = joints_[index];
    joint.velocity_max = limits.velocity;
    joint.actuated = true;
    joint.effort_max = limits.effort_per_mass * table_.mass();
    joint.effort_min = -joint.effort_max;
    return index;
  }

  // Flexion about y, adduction about x, internal rotation about z; the last two have mirrored axes.
  int AddBall(const std::string& name, BodySide side, int parent, const Vector3& origin) {
    const double sign = side == BodySide::kLeft ? -1 : 1;
    const int flexion = AddActuated(name, side, parent, origin, -Vector3::UnitY());
    const int adduction = AddActuated(name + "_adduction", side, flexion, Vector3::Zero(), sign * Vector3::UnitX());
    return AddActuated(name + "_rotation", side, adduction, Vector3::Zero(), sign * Vector3::UnitZ());
  }

  void SetLink(int joint, const std::string& link, const RigidBody& body) {
    joints_[joint].link = link;
    joints_[joint].mass = body.mass;
    joints_[joint].center_of_mass = body.center_of_mass;
    joints_[joint].inertia = body.inertia;
  }

  void AddBase() {
    const Vector3 zero = Vector3::Zero();
    const int x = Add("base_x", BodySide::kMidline, JointType::kPrismatic, -1, zero, Vector3::UnitX());
    const int y = Add("base_y", BodySide::kMidline, JointType::kPrismatic, x, zero, Vector3::UnitY());
    const int z = Add("base_z", BodySide::kMidline, JointType::kPrismatic, y, zero, Vector3::UnitZ());
    const int yaw = Add("base_yaw", BodySide::kMidline, JointType::kRevolute, z, zero, Vector3::UnitZ());
    const int roll = Add("base_roll", BodySide::kMidline, JointType::kRevolute, yaw, zero, Vector3::UnitX());
    pelvis_ = Add("base_pitch", BodySide::kMidline, JointType::kRevolute, roll, zero, Vector3::UnitY());
    for (int joint : {y, yaw, roll}) joints_[joint].mirror_sign = -1;
    for (int joint : {yaw, roll, pelvis_}) SetRange(joints_[joint].name, &joints_[joint]);
    SetLink(pelvis_, "pelvis", OnLink(Segment::kPelvis, BodySide::kMidline));
  }

  void AddLeg(BodySide side) {
    const SegmentTable& table = Of(side);
    const std::string suffix = Suffix(side);
    const double sign = side == BodySide::kLeft ? -1 : 1;
    const int thigh = AddBall("hip", side, pelvis_, Vector3(0, -sign * table.HalfHipWidth(), 0));
    const int shank = AddActuated("knee", side, thigh, Vector3(0, 0, -table.Length(Segment::kThigh)), Vector3::UnitY());
    const int ankle =
        AddActuated("ankle", side, shank, Vector3(0, 0, -table.Length(Segment::kShank)), -Vector3::UnitY());
    const int foot = AddActuated("ankle_inversion", side, ankle, Vector3::Zero(), sign * Vector3::UnitX());
    SetLink(thigh, "thigh" + suffix, table.Body(Segment::kThigh, side));
    SetLink(shank, "shank" + suffix, table.Body(Segment::kShank, side));
    int toes = foot;
    if (options_.toes) {
      const FootBodies bodies = SplitFoot(table, side);
      toes = AddActuated("toe", side, foot, table.AnkleToToes(), -Vector3::UnitY());
      SetLink(foot, "foot" + suffix, bodies.foot);
      SetLink(toes, "toes" + suffix, bodies.toes);
    } else {
      SetLink(foot, "foot" + suffix, table.Body(Segment::kFoot, side));
    }
    for (const FootSurface& surface :
         FootSurfaces(table, options_.feet, side == BodySide::kRight ? options_.right_foot : options_.left_foot)) {
      const bool on_toes = surface.on_toes && options_.toes;
      ContactSurface contact;
      contact.name = Sided(side, surface.name);
      contact.joint = on_toes ? toes : foot;
      contact.surface = surface.surface;
      contact.side = side;
      contact.part = surface.part;
      contact.p_LE = on_toes ? surface.center - table.AnkleToToes() : surface.center;
      contacts_.push_back(contact);
      AddLimb(LimbPart::kFoot, side, surface.name, contact.joint, {surface.surface, contact.p_LE});
    }
    if (options_.feet == FootShape::kTwoEllipsoids) AddLimb(LimbPart::kFoot, side, "instep", foot, InstepBody(table));
    AddLimb(LimbPart::kShank, side, "shank", shank, ShankBody(table));
    AddLimb(LimbPart::kThigh, side, "thigh", thigh, ThighBody(table));
  }

  void AddLimb(LimbPart part, BodySide side, const std::string& name, int joint, const LimbBody& limb) {
    const PlacedSurface placed{limb.surface, limb.center, Matrix3::Identity()};
    limbs_.push_back({part, side, {Sided(side, name), joint, placed, 0}});
  }

  // Torso and head on the lumbar joint; the torso's mass properties are about the cervical joint.
  void AddTrunk() {
    const int flexion =
        AddActuated("trunk_flexion", BodySide::kMidline, pelvis_, -table_.LumbarToHips(), Vector3::UnitY());
    const int bending = AddActuated("trunk_bending", BodySide::kMidline, flexion, Vector3::Zero(), Vector3::UnitX());
    torso_ = AddActuated("trunk_rotation", BodySide::kMidline, bending, Vector3::Zero(), Vector3::UnitZ());
    for (int joint : {bending, torso_}) joints_[joint].mirror_sign = -1;
    cervical_ = PlaceOf(Segment::kTorso, BodySide::kMidline, table_).origin;
    SetLink(torso_, "torso",
            Lumped({OnLink(Segment::kTorso, BodySide::kMidline), OnLink(Segment::kHeadNeck, BodySide::kMidline)}));
  }

  // The hand is one body with the forearm.
  void AddArm(BodySide side) {
    const SegmentTable& table = Of(side);
    const std::string suffix = Suffix(side);
    const int arm = AddBall("shoulder", side, torso_, cervical_ + table.CervicalToShoulder(side));
    const int forearm =
        AddActuated("elbow", side, arm, Vector3(0, 0, -table.Length(Segment::kUpperArm)), -Vector3::UnitY());
    SetLink(arm, "upper_arm" + suffix, table.Body(Segment::kUpperArm, side));
    SetLink(forearm, "forearm" + suffix, Lumped({OnLink(Segment::kForearm, side), OnLink(Segment::kHand, side)}));
    AddLimb(LimbPart::kForearm, side, "forearm", forearm, ForearmBody(table));
  }

  void PairJoints() {
    for (size_t i = 0; i < joints_.size(); ++i) {
      for (size_t k = 0; k < joints_.size(); ++k) {
        std::string image = joints_[i].name;
        if (image.ends_with("_l"))
          image.back() = 'r';
        else if (image.ends_with("_r"))
          image.back() = 'l';
        if (joints_[k].name == image) joints_[i].mirror_joint = static_cast<int>(k);
      }
    }
  }

  const SegmentTable &table_, &right_;  // of the left side and the middle; of the right side
  HumanOptions options_;
  int pelvis_ = -1, torso_ = -1;
  Vector3 cervical_ = Vector3::Zero();  // from the lumbar joint
  std::vector<Joint> joints_;
  std::vector<ContactSurface> contacts_;
  std::vector<LimbSurface> limbs_;
};

}  // namespace

HumanBody Human(const SegmentTable& table, const HumanOptions& options) { return Human(table, table, options); }

HumanBody Human(const SegmentTable& left, const SegmentTable& right, const HumanOptions& options) {
  ROLLGAIT_CHECK(!options.toes || options.feet == FootShape::kTwoEllipsoids);
  return HumanBuilder(left, right, options).Build();
}

SegmentPlace PlaceOf(Segment segment, BodySide side, const SegmentTable& table) {
  const std::string suffix = Suffix(side);
  switch (segment) {
    case Segment::kHeadNeck:
    case Segment::kTorso:
      return {"trunk_rotation", Vector3(0, 0, table.Length(Segment::kTorso))};
    case Segment::kPelvis:
      return {"base_pitch", -table.LumbarToHips()};
    case Segment::kUpperArm:
      return {"shoulder_rotation" + suffix};
    case Segment::kForearm:
      return {"elbow" + suffix};
    case Segment::kHand:
      return {"elbow" + suffix, Vector3(0, 0, -table.Length(Segment::kForearm))};
    case Segment::kThigh:
      return {"hip_rotation" + suffix};
    case Segment::kShank:
      return {"knee" + suffix};
    case Segment::kFoot:
      return {"ankle_inversion" + suffix};
  }
  ROLLGAIT_CHECK(false);
}

std::vector<std::string> HumanSources(bool symmetric) {
  std::vector<std::string> sources = SegmentTable::Sources();
  sources.push_back(
      symmetric
          ? "Left segments mirror the right ones; head, torso and pelvis are made symmetric about the sagittal plane."
          : "Left segments mirror the right ones but for what the request changes: left and right of this body "
            "differ. Head, torso and pelvis are those of the table, made symmetric about the sagittal plane.");
  for (const std::vector<std::string>& more :
       {FootSources(), LimbBodySources(), JointLimitSources(), PassiveTorqueSources()}) {
    sources.insert(sources.end(), more.begin(), more.end());
  }
  sources.push_back(
      "Posture at zero: lumbar and cervical joints on one vertical, hips ahead of it as the table has them. The centre "
      "of "
      "mass of pelvis, torso, head and arms is then 0.063 m (male, 1.774 m) or 0.058 m (female, 1.610 m) behind the "
      "hips, so "
      "balance takes some forward lean.");
  sources.push_back(
      "Joint axes: parallel to those of the standing body; hip, shoulder and trunk turn about y, x, z in this order, "
      "the "
      "foot about y (dorsiflexion) and x (inversion) through one centre, a simplification of the oblique subtalar "
      "axis.");
  return sources;
}

}  // namespace rollgait
