#include "core/models/mirror_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollgait {
namespace {

constexpr double kTolerance = 1e-9;

// Links at position zero in world axes.
class Comparison {
 public:
  Comparison(const Model& model, const std::vector<ContactSurface>& contacts, MotionSpace space)
      : model_(model), contacts_(contacts), plane_(space == MotionSpace::kSagittalPlane) {
    for (const Joint& joint : model.joints()) {
      const bool root = joint.parent < 0;
      const Matrix3 parent = root ? Matrix3(Matrix3::Identity()) : rotation_[static_cast<size_t>(joint.parent)];
      const Vector3 from = root ? Vector3(Vector3::Zero()) : origin_[static_cast<size_t>(joint.parent)];
      rotation_.push_back(parent * joint.R_PJ);
      origin_.push_back(from + parent * joint.p_PJ);
    }
  }

  bool IsMirrored(int index) const {
    const Joint& joint = model_.joint(index);
    const Joint& image = model_.joint(joint.mirror_joint);
    const Matrix3 &R = Rotation(index), &R_image = Rotation(joint.mirror_joint);
    // The axis of a turn is a pseudovector; along it the image of one that also moves advances the other way.
    const bool turns = joint.kind().turns;
    const double sign = joint.mirror_sign * (turns ? -1 : 1);
    const Vector3 axis = R * joint.axis, axis_image = sign * Mirrored(R_image * image.axis);
    return (axis - axis_image).norm() <= kTolerance &&
           std::abs(joint.Advance() - (turns ? -1 : 1) * image.Advance()) <= kTolerance &&
           IsPlace(Origin(index), Origin(joint.mirror_joint)) &&
           std::abs(joint.mass - image.mass) <= kTolerance * joint.mass &&
           (joint.mass == 0 ||
            IsPlace(At(index, joint.center_of_mass), At(joint.mirror_joint, image.center_of_mass))) &&
           IsInertia(R * joint.inertia * R.transpose(), R_image * image.inertia * R_image.transpose()) &&
           HasSameLimits(joint, image);
  }

  bool IsMirrored(const ContactSurface& contact) const {
    const ContactSurface& image = contacts_[static_cast<size_t>(contact.mirror_contact)];
    const Matrix3 R = Rotation(contact.joint) * contact.R_LE, R_image = Rotation(image.joint) * image.R_LE;
    // Of a surface by its shape: axes may point either way.
    return IsPlace(At(contact.joint, contact.p_LE), At(image.joint, image.p_LE)) &&
           SupportDifference(contact.surface, R, image.surface, Mirror() * R_image) <= kTolerance &&
           contact.part == image.part;
  }

 private:
  static Matrix3 Mirror() { return Vector3(1, -1, 1).asDiagonal(); }
  static Vector3 Mirrored(const Vector3& of) { return Vector3(of.x(), -of.y(), of.z()); }
  const Matrix3& Rotation(int link) const { return rotation_[static_cast<size_t>(link)]; }
  const Vector3& Origin(int link) const { return origin_[static_cast<size_t>(link)]; }
  Vector3 At(int link, const Vector3& place) const { return Origin(link) + Rotation(link) * place; }

  bool IsPlace(const Vector3& place, const Vector3& image) const {
    Vector3 apart = place - Mirrored(image);
    if (plane_) apart.y() = 0;
    return apart.norm() <= kTolerance;
  }

  bool IsInertia(const Matrix3& inertia, const Matrix3& image) const {
    if (plane_) return std::abs(inertia(1, 1) - image(1, 1)) <= kTolerance * inertia(1, 1);
    return (inertia - Mirror() * image * Mirror()).norm() <= kTolerance * inertia.norm();
  }

  static bool HasSameLimits(const Joint& joint, const Joint& image) {
    const double sign = joint.mirror_sign;
    return IsMirroredRange(joint.position_min, joint.position_max, image.position_min, image.position_max, sign) &&
           IsMirroredRange(joint.effort_min, joint.effort_max, image.effort_min, image.effort_max, sign) &&
           joint.velocity_max == image.velocity_max && joint.actuated == image.actuated &&
           joint.passive == image.passive && HasMirroredSpring(joint, image);
  }

  const Model& model_;
  const std::vector<ContactSurface>& contacts_;
  bool plane_;
  std::vector<Matrix3> rotation_;
  std::vector<Vector3> origin_;
};

}  // namespace

bool IsMirroredRange(double min, double max, double image_min, double image_max, double mirror_sign) {
  return mirror_sign > 0 ? min == image_min && max == image_max : min == -image_max && max == -image_min;
}

bool HasMirroredSpring(const Joint& joint, const Joint& image) {
  return joint.stiffness == image.stiffness && joint.damping == image.damping &&
         (joint.stiffness == 0 || joint.rest_position == joint.mirror_sign * image.rest_position);
}

bool IsOwnMirrorImage(const Model& model, const std::vector<ContactSurface>& contacts, MotionSpace space) {
  const Comparison comparison(model, contacts, space);
  for (int i = 0; i < model.size(); ++i) {
    if (!comparison.IsMirrored(i)) return false;
  }
  return std::all_of(contacts.begin(), contacts.end(),
                     [&](const ContactSurface& contact) { return comparison.IsMirrored(contact); });
}

Model WithoutMirror(const Model& model) {
  std::vector<Joint> joints = model.joints();
  for (size_t i = 0; i < joints.size(); ++i) {
    joints[i].mirror_joint = static_cast<int>(i);
    joints[i].mirror_sign = 1;
  }
  return Model::Create(std::move(joints)).value();
}

}  // namespace rollgait
