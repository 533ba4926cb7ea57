#include "core/models/sidedness.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

bool AreClose(double a, double b) { return std::abs(a - b) <= 1e-9 * (1 + std::abs(a)); }

// "knee_r" of "knee_l"; a name without a side: itself.
std::string ImageName(std::string name) {
  if (name.ends_with("_l") || name.ends_with("_r")) name.back() = name.back() == 'l' ? 'r' : 'l';
  return name;
}

// Whether the mirror image of a load is among the loads: of one in the middle itself.
bool HasImage(const SegmentLoad& load, const std::vector<SegmentLoad>& loads) {
  const auto to_right = [](const SegmentLoad& at) { return at.position ? at.position->z() : 0.0; };
  return std::any_of(loads.begin(), loads.end(), [&](const SegmentLoad& other) {
    const bool same_place = load.position.has_value() == other.position.has_value() &&
                            (!load.position || load.position->head<2>() == other.position->head<2>());
    return other.segment == ImageName(load.segment) && other.mass == load.mass && other.moments == load.moments &&
           same_place && to_right(other) == -to_right(load);
  });
}

Vector3 Flipped(const Vector3& vector) { return Vector3(vector.x(), -vector.y(), vector.z()); }

}  // namespace

bool MayBeOneSided(const BodySelection& selection) {
  for (const auto& [name, length] : selection.segment_lengths) {
    if (name.ends_with("_l") || name.ends_with("_r")) return true;
  }
  const SubjectChanges& changes = selection.changes;
  return !changes.loads.empty() || !changes.strengths.empty() || !changes.springs.empty();
}

std::vector<std::string> OneSidedFields(const BodyRequest& request) {
  std::vector<std::string> fields;
  const auto add = [&](const char* field, const auto& named, const auto& middle_is_alike) {
    for (const auto& [name, value] : named) {
      const std::string image = ImageName(name);
      const auto other = named.find(image);
      if (image == name ? middle_is_alike(name, value) : other != named.end() && other->second == value) continue;
      fields.push_back(std::string(field) + "[\"" + name + "\"]");
    }
  };
  const auto always = [](const std::string&, const auto&) { return true; };
  // Bending and turning of the trunk are their own mirror images with the opposite sign.
  const auto at_zero = [](const std::string& name, double value) { return name == "trunk_flexion" || value == 0; };
  const SubjectChanges& changes = request.changes;
  add("segment_lengths_m", request.segment_lengths, always);
  add("locked_joints_rad", request.locked_joints, at_zero);
  add("foot_semi_axes_m", changes.foot_semi_axes, always);
  add("joint_strengths", changes.strengths, always);
  add("joint_springs", changes.springs, [&](const std::string& name, const JointSpring& spring) {
    return spring.stiffness == 0 || at_zero(name, spring.rest);
  });
  for (size_t i = 0; i < changes.loads.size(); ++i) {
    if (!HasImage(changes.loads[i], changes.loads)) fields.push_back("loads[" + std::to_string(i) + "]");
  }
  if (request.own) fields.push_back("own");
  return fields;
}

BodyRequest WithSidesAlike(BodyRequest request) {
  const auto of_one_side = [](const auto& named) { return ImageName(named.first) != named.first; };
  std::map<std::string, Vector3> feet = std::move(request.changes.foot_semi_axes);
  std::erase_if(feet, of_one_side);
  request.changes = {};
  request.changes.foot_semi_axes = std::move(feet);
  std::erase_if(request.segment_lengths, of_one_side);
  const std::map<std::string, double> locked = request.locked_joints;
  std::erase_if(request.locked_joints, [&](const auto& named) {
    const std::string image = ImageName(named.first);
    if (image == named.first) return image.starts_with("trunk_") && named.second != 0;
    const auto other = locked.find(image);
    return other == locked.end() || other->second != named.second;
  });
  return request;
}

bool AreMirrored(const std::vector<Joint>& joints) {
  for (const Joint& joint : joints) {
    const Joint& image = joints[static_cast<size_t>(joint.mirror_joint)];
    const double sign = joint.mirror_sign;
    const Matrix3 flip = Vector3(1, -1, 1).asDiagonal();
    const double size = joint.inertia.norm();
    const bool same_link = (joint.p_PJ - Flipped(image.p_PJ)).norm() <= 1e-9 && AreClose(joint.mass, image.mass) &&
                           (joint.center_of_mass - Flipped(image.center_of_mass)).norm() <= 1e-9 &&
                           (joint.inertia - flip * image.inertia * flip).norm() <= 1e-9 * size;
    const bool same_effort = sign > 0 ? joint.effort_min == image.effort_min && joint.effort_max == image.effort_max
                                      : joint.effort_min == -image.effort_max && joint.effort_max == -image.effort_min;
    const bool same_spring = joint.stiffness == image.stiffness && joint.damping == image.damping &&
                             (joint.stiffness == 0 || joint.rest_position == sign * image.rest_position);
    if (!same_link || !same_effort || !same_spring || joint.actuated != image.actuated) return false;
  }
  return true;
}

void ForgetMirror(std::vector<Joint>* joints) {
  for (size_t i = 0; i < joints->size(); ++i) {
    (*joints)[i].mirror_joint = static_cast<int>(i);
    (*joints)[i].mirror_sign = 1;
  }
}

}  // namespace rollgait
