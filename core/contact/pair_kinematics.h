#ifndef ROLLGAIT_CORE_CONTACT_PAIR_KINEMATICS_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_KINEMATICS_H_

#include "core/contact/contact_pair.h"

namespace rollgait {

// Kinematics of one contact between body 1 and body 2 (or a plane). World axes. Exact also when the bodies do not touch
// (gap ≠ 0) and when they slip. For a plane, its material point is the one that is now at p_1, whatever the gap.
// Three velocities are kept apart: that of the material points (slip is their difference), that of the geometric points
// (p_dot_1, p_dot_2), and their difference, the motion of a point over its surface. Source: contact-math 3, 4, 5, 8.
struct PairKinematics {
  Vector3 p_1, p_2;          // m, contact points; p_1 − p_2 = gap · normal. Plane: p_2 is the projection of p_1
  Vector3 normal;            // unit, from body 2 towards body 1
  double gap = 0;            // m, signed distance
  double gap_rate = 0;       // m/s, normal · slip
  Vector3 slip;              // m/s, w = v₁(P₁) − v₂(P₂)
  Vector3 p_dot_1, p_dot_2;  // m/s, velocities of the geometric points
  Vector3 normal_dot;        // 1/s
  // m/s², ẇ with the accelerations of the two frames as they were passed: γ if those are the bias accelerations at zero
  // joint accelerations (ẇ = J v̇ + γ), all of ẇ if they are complete.
  Vector3 drift;
  double gap_acceleration = 0;  // m/s², second derivative of the gap with the same accelerations
  // False where a surface is flat at its contact point (S infinite, contact-math 2.2): then the velocity of the contact
  // points, drift, gap_acceleration (for two surfaces normal_dot, too) do not exist and every entry is +infinity.
  // Points, gap, gap_rate and slip are right. An acceleration-level constraint cannot be formed there.
  bool regular = true;
};

// The rows of ∂slip/∂(twists): slip = J_1 (v_1, w_1) − J_2 (v_2, w_2) of the two frame origins with J_i = [I, −[r_i]×];
// r_1 = p_1 − p_WB1, and r_2 = p_2 − p_WB2 (for a plane p_1 − p_WB2).
struct PairLevers {
  Vector3 r_1, r_2;  // m, world
};

// A surface over a plane. Closed form. Contract: unit normal, rotations orthonormal.
PairKinematics ComputePlaneContact(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                   const FrameMotion& plane_frame);
PairLevers PlaneContactLevers(const PairKinematics& kinematics, const FrameMotion& body,
                              const FrameMotion& plane_frame);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_KINEMATICS_H_
