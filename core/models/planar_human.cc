#include "core/models/planar_human.h"

#include <numbers>
#include <utility>

#include "core/base/check.h"
#include "core/models/segment_table.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Sole radius of curvature a²/c over leg length: human feet roll like such a wheel (Adamczyk, Collins, Kuo 2006).
constexpr double kRollingRadius = 0.3;
// Half foot breadth over foot length (101 of 270 mm, US Army male survey of 1988; from memory). No effect in the plane.
constexpr double kHalfFootBreadth = 0.187;

// What a joint of the leg may do. Flexion, flexion and dorsiflexion are positive.
struct LegJointLimits {
  double position_min, position_max;  // degrees
  double velocity;                    // rad/s
  double effort_per_mass;             // N m/kg, both directions
};
constexpr LegJointLimits kHip = {-30, 120, 15, 200.0 / 75};
constexpr LegJointLimits kKnee = {0, 150, 20, 250.0 / 75};
constexpr LegJointLimits kAnkle = {-50, 40, 20, 250.0 / 75};

void SetLink(const char* link, const RigidBody& body, Joint* joint) {
  joint->link = link;
  joint->mass = body.mass;
  joint->center_of_mass = body.center_of_mass;
  joint->inertia = body.inertia;
}

// Pelvis, torso, head and straight hanging arms, about the middle of the hip joint centres.
RigidBody Trunk(const SegmentTable& table) {
  const Vector3 lumbar = -table.LumbarToHips();
  const Vector3 cervical = lumbar + Vector3(0, 0, table.Length(Segment::kTorso));
  std::vector<RigidBody> parts = {
      Shifted(table.Body(Segment::kPelvis, Side::kMidline), lumbar),
      Shifted(table.Body(Segment::kTorso, Side::kMidline), cervical),
      Shifted(table.Body(Segment::kHeadNeck, Side::kMidline), cervical),
  };
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Vector3 joint = cervical + table.CervicalToShoulder(side);
    for (const Segment segment : {Segment::kUpperArm, Segment::kForearm, Segment::kHand}) {
      parts.push_back(Shifted(table.Body(segment, side), joint));
      joint.z() -= table.Length(segment);
    }
  }
  return Lumped(parts);
}

Joint BaseJoint(const char* name, JointType type, const Vector3& axis, int parent) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.axis = axis;
  joint.parent = parent;
  return joint;
}

Joint LegJoint(const std::string& name, int parent, const Vector3& origin, const Vector3& axis,
               const LegJointLimits& limits, double body_mass) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.p_PJ = origin;
  joint.axis = axis;
  joint.position_min = limits.position_min * kDegree;
  joint.position_max = limits.position_max * kDegree;
  joint.velocity_max = limits.velocity;
  joint.actuated = true;
  joint.effort_max = limits.effort_per_mass * body_mass;
  joint.effort_min = -joint.effort_max;
  return joint;
}

// Appends hip, knee and ankle of one side to the three joints of the base.
void AddLeg(const SegmentTable& table, Side side, double mass, std::vector<Joint>* joints) {
  constexpr int kTrunk = 2;
  const bool left = side == Side::kLeft;
  const std::string suffix = left ? "_l" : "_r";
  const Vector3 hip(0, (left ? 1 : -1) * table.HalfHipWidth(), 0);
  const Vector3 y = Vector3::UnitY();
  const int first = static_cast<int>(joints->size());
  joints->push_back(LegJoint("hip" + suffix, kTrunk, hip, -y, kHip, mass));
  joints->push_back(
      LegJoint("knee" + suffix, first, Vector3(0, 0, -table.Length(Segment::kThigh)), y, kKnee, mass));
  joints->push_back(
      LegJoint("ankle" + suffix, first + 1, Vector3(0, 0, -table.Length(Segment::kShank)), -y, kAnkle, mass));
  SetLink(left ? "thigh_l" : "thigh_r", table.Body(Segment::kThigh, side), &(*joints)[first]);
  SetLink(left ? "shank_l" : "shank_r", table.Body(Segment::kShank, side), &(*joints)[first + 1]);
  SetLink(left ? "foot_l" : "foot_r", table.Body(Segment::kFoot, side), &(*joints)[first + 2]);
  for (int i = 0; i < 3; ++i) (*joints)[first + i].mirror_joint = left ? first + 3 + i : first - 3 + i;
}

// The foot's ellipsoid spans the foot from heel to toe; its lowest point is at the sole when the foot is level.
ContactSurface Foot(const SegmentTable& table, const char* name, int joint, int mirror) {
  const double a = table.FootLength() / 2;
  const double c = a * a / (kRollingRadius * table.LegLength());
  ContactSurface foot;
  foot.name = name;
  foot.joint = joint;
  foot.surface = Ellipsoid(Vector3(a, kHalfFootBreadth * table.FootLength(), c));
  foot.p_LE = Vector3(a - table.HeelToAnkle(), 0, c - table.AnkleHeight());
  foot.mirror_contact = mirror;
  foot.directions = {0, 2};
  return foot;
}

std::vector<std::string> Sources() {
  std::vector<std::string> sources = SegmentTable::Sources();
  const std::vector<std::string> own = {
      "Feet: ellipsoids from heel to toe (a = half foot length) whose sole has the radius of curvature a²/c = 0.3 × leg "
      "length (Adamczyk, Collins, Kuo 2006, J Exp Biol 209:3953); bottom at the sole of the standing foot; half breadth "
      "0.187 × foot length (US Army survey 1988, male means, from memory).",
      "Posture at zero: lumbar and cervical joints on one vertical, hips ahead of it as the table has them. The trunk's "
      "centre of mass is then 0.063 m (male, 1.774 m) or 0.058 m (female, 1.610 m) behind the hips, so balance takes some "
      "forward lean.",
      "Ranges of motion: hip -30..120 and ankle -50 deg, AAOS 1965 norms; knee 0..150 deg, AMA guides; 40 deg of ankle "
      "dorsiflexion are reached under weight only (lunge test). From memory of these norms.",
      "Torque limits: 200 N m (hip), 250 N m (knee, ankle) at 75 kg in both directions, proportional to body mass: above "
      "the isometric maxima of young adults (Anderson, Madigan, Nussbaum 2007, J Biomech 40:3105; from memory) so that "
      "walking meets them rarely. Velocity limits: 15 rad/s (hip), 20 rad/s (knee, ankle), chosen well above walking.",
  };
  sources.insert(sources.end(), own.begin(), own.end());
  return sources;
}

}  // namespace

Scene PlanarHuman(Sex sex, double stature, double mass) {
  const SegmentTable table(sex, stature, mass);
  std::vector<Joint> joints = {
      BaseJoint("base_x", JointType::kPrismatic, Vector3::UnitX(), -1),
      BaseJoint("base_z", JointType::kPrismatic, Vector3::UnitZ(), 0),
      BaseJoint("base_pitch", JointType::kRevolute, Vector3::UnitY(), 1),
  };
  joints[0].link = "base_slide_x";
  joints[1].link = "base_slide_z";
  SetLink("trunk", Trunk(table), &joints[2]);
  AddLeg(table, Side::kLeft, mass, &joints);
  AddLeg(table, Side::kRight, mass, &joints);

  Result<Model> model = Model::Create(std::move(joints));
  ROLLGAIT_CHECK(model.ok());
  const int left_ankle = model.value().Find("ankle_l"), right_ankle = model.value().Find("ankle_r");
  return Scene{
      .name = "planar",
      .description = "Human in the sagittal plane: rigid trunk, hips, knees, ankles; ellipsoidal feet that roll.",
      .selection = {"planar", sex, stature, mass},
      .model = std::move(model).value(),
      .contacts = {Foot(table, "left_foot", left_ankle, 1), Foot(table, "right_foot", right_ankle, 0)},
      .leg_length = table.LegLength(),
      .sources = Sources(),
  };
}

}  // namespace rollgait
