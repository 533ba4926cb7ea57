#ifndef ROLLGAIT_CORE_MULTIBODY_JOINT_NUMBER_H_
#define ROLLGAIT_CORE_MULTIBODY_JOINT_NUMBER_H_

#include <cmath>

#include "core/multibody/model.h"

namespace rollgait {

// What Model::Create asks of a number for itself; kOther: rules of its own, which compare it with others.
enum class JointNumberRule { kOther, kFinite, kNotNegative, kPitch };

// A number that messages say of a joint.
struct JointNumber {
  double Joint::*member;
  const char* name;         // in violations of Model::Create
  const char* field;        // of rollgait.v1.Joint
  const char* scene_field;  // of rollgait.v1.SceneJoint; null: scenes do not say it
  JointNumberRule rule = JointNumberRule::kOther;
  bool of_free = true;  // a scene's free joint has it, too
};

// Every one of them; conversion and checks follow.
inline constexpr JointNumber kJointNumbers[] = {
    {&Joint::position_min, "position_min", "position_min", nullptr},
    {&Joint::position_max, "position_max", "position_max", nullptr},
    {&Joint::velocity_max, "velocity_max", "velocity_max", nullptr},
    {&Joint::effort_min, "effort_min", "effort_min", nullptr},
    {&Joint::effort_max, "effort_max", "effort_max", nullptr},
    {&Joint::mass, "mass", "mass_kg", "mass_kg"},
    {&Joint::stiffness, "stiffness", "stiffness", "stiffness", JointNumberRule::kNotNegative, false},
    {&Joint::damping, "damping", "damping", "damping", JointNumberRule::kNotNegative},
    {&Joint::rest_position, "rest_position", "rest_position", "rest", JointNumberRule::kFinite, false},
    {&Joint::pitch, "pitch", "pitch_m_rad", "pitch_m_rad", JointNumberRule::kPitch},
};

// What the number of this joint breaks of its rule; null: nothing.
inline const char* Problem(const JointNumber& number, const Joint& joint) {
  const double value = joint.*number.member;
  switch (number.rule) {
    case JointNumberRule::kFinite:
      return std::isfinite(value) ? nullptr : "must be finite";
    case JointNumberRule::kNotNegative:
      return std::isfinite(value) && value >= 0 ? nullptr : "must be finite and at least 0";
    case JointNumberRule::kPitch:
      if (joint.type != JointType::kScrew) return value == 0 ? nullptr : "must be 0: only a screw has a pitch";
      return std::abs(value) <= 1 && value != 0 ? nullptr : "must be within [-1, 1] m/rad and not 0";
    case JointNumberRule::kOther:
      break;
  }
  return nullptr;
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_JOINT_NUMBER_H_
