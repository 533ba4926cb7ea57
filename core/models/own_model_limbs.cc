// Joints, feet and mirror images of a walker given as data.
#include <algorithm>
#include <cmath>

#include "core/models/mirror_image.h"
#include "core/models/own_model_check.h"

namespace rollgait {
namespace {

constexpr double kMirrorTolerance = 1e-6;  // of masses and inertias; of lengths times the leg

void CheckLimits(int index, OwnModelCheck* check) {
  const Joint& joint = check->own.joints[index];
  if (!(joint.position_max > joint.position_min && std::isfinite(joint.position_max - joint.position_min))) {
    check->Refuse("joints", index, "position_min", "to position_max of joint \"", joint.name, "\" is ",
                  joint.position_min, " to ", joint.position_max,
                  "; give a finite range (rad or m) with min < max: this joint has no limits");
  }
  if (!joint.actuated) return;
  if (!std::isfinite(joint.velocity_max)) {
    check->Refuse("joints", index, "velocity_max", "of joint \"", joint.name, "\" is ", joint.velocity_max,
                  "; give a finite limit > 0 (rad/s or m/s)");
  }
  if (!(joint.effort_max > 0 && joint.effort_min < 0 && std::isfinite(joint.effort_max - joint.effort_min))) {
    check->Refuse("joints", index, "effort_max", "and effort_min of joint \"", joint.name, "\" are ", joint.effort_max,
                  " and ", joint.effort_min, "; give finite limits with min < 0 < max (N m or N)");
  }
}

void CheckRole(int index, OwnModelCheck* check) {
  const Joint& joint = check->own.joints[index];
  const double across = std::abs((check->R_WL[index] * joint.axis).y());
  if (joint.role != JointRole::kNone && (!joint.kind().turns || across < 0.5)) {
    check->Refuse("joints", index, "axis", "of joint \"", joint.name, "\" is (",
                  (check->R_WL[index] * joint.axis).transpose(),
                  ") in the world; the joint of a role turns within 60° of y, its component along y must reach 0.5");
  }
  const bool is_limb = joint.role >= JointRole::kHipFlexion;
  if (joint.role != JointRole::kNone && is_limb != (joint.side != BodySide::kMidline)) {
    check->Refuse("joints", index, "side", "of joint \"", joint.name, "\" must be ",
                  is_limb ? "left or right, as it has a role of a limb" : "unset, as it has a role of the trunk");
  }
  const auto needs = [&](PassiveKind passive, JointRole role, double sign) {
    if (joint.passive != passive) return;
    const double flexes = sign * (check->R_WL[index] * joint.axis).y();
    if (joint.role != role || !(flexes > 0)) {
      check->Refuse("joints", index, "passive", "of joint \"", joint.name,
                    "\" is that of another joint of people, or this one flexes at negative positions");
    }
  };
  needs(PassiveKind::kHumanHip, JointRole::kHipFlexion, -1);
  needs(PassiveKind::kHumanKnee, JointRole::kKneeFlexion, 1);
  needs(PassiveKind::kHumanAnkle, JointRole::kAnkleDorsiflexion, -1);
}

int FindRole(const OwnModel& own, JointRole role, BodySide side) {
  for (size_t i = 0; i < own.joints.size(); ++i) {
    if (own.joints[i].role == role && own.joints[i].side == side) return static_cast<int>(i);
  }
  return -1;
}

// A joint that bends a limb moves what lies behind it, so roles stand in this order from the base on; a start whose
// knee moves the hip along walks nowhere.
void CheckRoleOrder(JointRole first, JointRole second, OwnModelCheck* check) {
  const std::vector<Joint>& joints = check->own.joints;
  for (const BodySide side : {BodySide::kLeft, BodySide::kRight}) {
    const int near = FindRole(check->own, first, side), far = FindRole(check->own, second, side);
    if (near < 0 || far < 0) continue;
    int at = joints[far].parent;
    while (at >= 0 && at != near) at = joints[at].parent;
    if (at == near) continue;
    check->Refuse("joints", far, "role", "of joint \"", joints[far].name, "\" is behind that of joint \"",
                  joints[near].name,
                  "\", which does not move it: from the base on, roles stand in the order hip, knee, ankle and ",
                  "shoulder, elbow. Exchange the two roles, or leave one out");
  }
}

// The left hip is in +y of the right one, or in its place.
void CheckLeftIsLeft(double leg_length, OwnModelCheck* check) {
  const int left = FindRole(check->own, JointRole::kHipFlexion, BodySide::kLeft);
  const int right = FindRole(check->own, JointRole::kHipFlexion, BodySide::kRight);
  if (left < 0 || right < 0) return;
  const double apart = check->p_WL[left].y() - check->p_WL[right].y();
  if (apart >= -kMirrorTolerance * leg_length) return;
  check->Refuse("joints", left, "side", "of joint \"", check->own.joints[left].name, "\" is left, but it lies ", -apart,
                " m to the right of joint \"", check->own.joints[right].name,
                "\" where the body faces x; exchange the sides, or turn the base by 180° about z");
}

void CheckMirrorJoint(int index, double tolerance, OwnModelCheck* check) {
  const Joint& joint = check->own.joints[index];
  const int other = joint.mirror_joint < 0 ? index : joint.mirror_joint;
  const Joint& image = check->own.joints[other];
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  const auto differs = [&](const char* field, const auto& left, const auto& right, const char* unit) {
    check->Refuse(
        "joints", index, field, "of \"", joint.name, "\" is ", left, unit, ", but the mirror image of \"", image.name,
        "\" has ", right, unit,
        "; correct one of the two, or let every joint be its own mirror image with sign 1 and walk CYCLE_FULL");
  };
  const Matrix3 &R = check->R_WL[index], R_image = check->R_WL[other];
  const Vector3 origin = check->p_WL[index], expected = mirror * check->p_WL[other];
  if ((origin - expected).norm() > tolerance)
    differs("origin_m", origin.transpose(), expected.transpose(), " m (world)");
  // A turn's axis is a pseudovector, and the image of a screw is one of the opposite hand.
  const Vector3 axis = R * joint.axis, flip = mirror * (R_image * image.axis) * joint.mirror_sign;
  const Vector3 wanted = joint.kind().turns ? Vector3(-flip) : flip;
  if ((axis - wanted).norm() > kMirrorTolerance) differs("axis", axis.transpose(), wanted.transpose(), " (world)");
  if (std::abs(joint.pitch + image.pitch) > tolerance) differs("pitch_m_rad", joint.pitch, -image.pitch, " m/rad");
  if (std::abs(joint.mass - image.mass) > kMirrorTolerance * joint.mass) {
    differs("mass_kg", joint.mass, image.mass, " kg");
  }
  const Vector3 center = check->p_WL[index] + R * joint.center_of_mass;
  const Vector3 center_image = mirror * (check->p_WL[other] + R_image * image.center_of_mass);
  if (joint.mass > 0 && (center - center_image).norm() > tolerance) {
    differs("center_of_mass_m", center.transpose(), center_image.transpose(), " m (world)");
  }
  const Matrix3 inertia = R * joint.inertia * R.transpose();
  const Matrix3 inertia_image = mirror * R_image * image.inertia * R_image.transpose() * mirror;
  if ((inertia - inertia_image).norm() > kMirrorTolerance * inertia.norm()) {
    differs("inertia_kg_m2", inertia.diagonal().transpose(), inertia_image.diagonal().transpose(),
            " kg m² (xx, yy, zz)");
  }
  if (!IsMirroredRange(joint.position_min, joint.position_max, image.position_min, image.position_max,
                       joint.mirror_sign)) {
    differs("position_min", joint.position_min, joint.mirror_sign > 0 ? image.position_min : -image.position_max,
            " (or its position_max differs)");
  }
  if (!IsMirroredRange(joint.effort_min, joint.effort_max, image.effort_min, image.effort_max, joint.mirror_sign)) {
    differs("effort_max", joint.effort_max, joint.mirror_sign > 0 ? image.effort_max : -image.effort_min,
            " (or its effort_min differs)");
  }
  if (!HasMirroredSpring(joint, image)) {
    differs("stiffness", joint.stiffness, image.stiffness, " (or its damping or rest_position differs)");
  }
  if (joint.velocity_max != image.velocity_max) differs("velocity_max", joint.velocity_max, image.velocity_max, "");
}

}  // namespace

void CheckOwnJoints(double leg_length, OwnModelCheck* check) {
  bool is_driven = false;
  for (int i = 0; i < static_cast<int>(check->own.joints.size()); ++i) {
    const Joint& joint = check->own.joints[i];
    is_driven = is_driven || joint.actuated;
    if (IsOfBase(joint.role)) continue;
    CheckLimits(i, check);
    CheckRole(i, check);
  }
  if (!is_driven) check->RefuseModel("joints", "have no actuated one; a walker needs at least one");
  CheckRoleOrder(JointRole::kHipFlexion, JointRole::kKneeFlexion, check);
  CheckRoleOrder(JointRole::kHipFlexion, JointRole::kAnkleDorsiflexion, check);
  CheckRoleOrder(JointRole::kKneeFlexion, JointRole::kAnkleDorsiflexion, check);
  CheckRoleOrder(JointRole::kShoulderFlexion, JointRole::kElbowFlexion, check);
  CheckLeftIsLeft(leg_length, check);
}

void CheckOwnChains(OwnModelCheck* check) {
  const std::vector<Joint>& joints = check->own.joints;
  for (const JointChain& chain : check->own.chains) {
    const std::string path = "joints[" + std::to_string(check->Named(chain.first)) + "].name";
    const auto is_same = [&](const auto& other) { return &other.name != &chain.name && other.name == chain.name; };
    if (!IsOwnName(chain.name)) {
      check->RefuseModel(path, "is not 1 to 64 letters, digits, \"_\", \"-\" or \".\"");
      continue;
    }
    if (std::any_of(joints.begin(), joints.end(), is_same) ||
        std::any_of(check->own.chains.begin(), check->own.chains.end(), is_same)) {
      check->RefuseModel(path, "\"", chain.name,
                         "\" is also the name of another joint or coordinate; give each its own");
    }
    int joint = chain.first;
    if (const std::string problem = AxesProblem(chain, joints, &joint); !problem.empty()) {
      check->Refuse("joints", joint, "axis", "of \"", joints[joint].name, "\", a coordinate of joint \"", chain.name,
                    "\", ", problem);
      continue;
    }
    for (int i = chain.first; i <= chain.last(); ++i) {
      const std::string problem =
          RangeProblem(check->own.chains, joints, i, joints[i].position_min, joints[i].position_max);
      if (problem.empty()) continue;
      check->Refuse("joints", i, "position_min", "to position_max of \"", joints[i].name, "\" ", problem);
    }
  }
}

void CheckOwnFeet(double leg_length, OwnModelCheck* check) {
  const OwnModel& own = check->own;
  double left = kInfinity, right = kInfinity;
  for (int c = 0; c < static_cast<int>(own.contacts.size()); ++c) {
    const ContactSurface& contact = own.contacts[c];
    if (contact.side == BodySide::kMidline) {
      check->Refuse("contacts", c, "side", "of \"", contact.name, "\" is unset; say which foot it belongs to");
      continue;
    }
    double* const sole = contact.side == BodySide::kLeft ? &left : &right;
    *sole = std::min(*sole, check->Lowest(contact));
    if (IsOfBase(own.joints[contact.joint].role)) {
      check->Refuse("contacts", c, "joint", "of \"", contact.name, "\" is a joint of the base; a foot hangs on a leg");
    }
  }
  if (std::abs(left - right) > leg_length / 5) {
    check->RefuseModel("contacts", "have the lowest points of left and right foot at ", left, " and ", right,
                       " m at position zero; they may differ by a fifth of the leg, ", leg_length / 5, " m");
  }
  for (int i = 0; i < static_cast<int>(own.joints.size()); ++i) {
    const Joint& joint = own.joints[i];
    const double height = (check->p_WL[i] + check->R_WL[i] * joint.center_of_mass).z();
    if (joint.mass > 0 && height < std::min(left, right)) {
      check->Refuse("joints", i, "center_of_mass_m", "of link \"", joint.link, "\" is at height ", height,
                    " m at position zero, below the soles at ", std::min(left, right),
                    " m; the feet cannot reach the ground");
    }
  }
}

void CheckOwnMirror(double leg_length, OwnModelCheck* check) {
  const std::vector<Joint>& joints = check->own.joints;
  bool mirrors = false;
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) {
    mirrors = mirrors || joints[i].mirror_sign < 0 || (joints[i].mirror_joint >= 0 && joints[i].mirror_joint != i);
  }
  if (!mirrors) return;  // left and right differ, and the model says so
  const double tolerance = kMirrorTolerance * leg_length;
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) CheckMirrorJoint(i, tolerance, check);
  for (int c = 0; c < static_cast<int>(check->own.contacts.size()); ++c) {
    const ContactSurface& contact = check->own.contacts[c];
    const ContactSurface& image = check->own.contacts[contact.mirror_contact];
    const auto center = [&](const ContactSurface& of) {
      return Vector3(check->p_WL[of.joint] + check->R_WL[of.joint] * of.p_LE);
    };
    const Vector3 expected = Vector3(1, -1, 1).cwiseProduct(center(image));
    const Matrix3 same = Matrix3::Identity();
    const bool same_shape = SupportDifference(contact.surface, same, image.surface, same) == 0;
    if ((center(contact) - expected).norm() > tolerance || !same_shape || contact.part != image.part) {
      check->Refuse("contacts", c, "mirror_contact", "of \"", contact.name, "\" is \"", image.name,
                    "\", which differs in centre (", center(contact).transpose(), " and mirrored ",
                    expected.transpose(), " m), shape or part");
    }
  }
}

}  // namespace rollgait
