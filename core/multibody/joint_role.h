#ifndef ROLLGAIT_CORE_MULTIBODY_JOINT_ROLE_H_
#define ROLLGAIT_CORE_MULTIBODY_JOINT_ROLE_H_

namespace rollgait {

// Which side of a body a part is on.
enum class BodySide { kMidline, kLeft, kRight };

// What a joint is for in walking: initial guess, presets and the comparison with people find joints by role, never by
// name. At most one joint of a model has a given role on a given side. World axes: x forward, y left, z up. See
// rollgait.v1.Joint.Role.
enum class JointRole {
  kNone,
  // The floating base, kMidline: translations of the base along x, y and z, then its turns about z, x and y.
  kBaseForward,
  kBaseLateral,
  kBaseVertical,
  kBaseYaw,
  kBaseRoll,
  kBasePitch,
  kTrunkFlexion,  // kMidline: bends the trunk forward on the base
  // Of a leg or arm, kLeft or kRight. In the zero posture each turns about ±y; FlexionSign() tells which.
  kHipFlexion,
  kKneeFlexion,
  kAnkleDorsiflexion,
  kShoulderFlexion,
  kElbowFlexion,
};

// Whether a joint is one of the floating base.
constexpr bool IsOfBase(JointRole role) { return role >= JointRole::kBaseForward && role <= JointRole::kBasePitch; }

// What ligaments and stretched muscles exert on a joint; core/models/passive_torque.h has the curves.
enum class PassiveKind {
  kNone,
  kHumanHip,
  kHumanKnee,
  kHumanAnkle,  // as measured on people; positive is flexion or dorsiflexion
  kStops,       // assumed: near the ends of the range only
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_JOINT_ROLE_H_
