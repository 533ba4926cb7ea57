#ifndef ROLLGAIT_CORE_CONTACT_ROW_DERIVATIVES_H_
#define ROLLGAIT_CORE_CONTACT_ROW_DERIVATIVES_H_

#include "core/contact/constrained_dynamics.h"
#include "core/contact/pair_derivatives.h"
#include "core/contact/tree_contact.h"

namespace rollgait {

// Derivatives of what one active contact contributes to the saddle-point system of ContactDynamics. Columns: changes of
// the two bodies in the order of PairDerivatives' ζ: pose (δp_1, δθ_1, δp_2, δθ_2), twist (v_1, w_1, v_2, w_2),
// accelerations (a_1, alpha_1, a_2, alpha_2), all in world axes at the frames' origins, accelerations complete.
struct RowDerivatives {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 4, 12>;
  Rows by_pose, by_twist, by_acceleration;  // of the contact's rows of  J v̇ − r
  // At fixed row forces: the wrenches on body 1 (first six) and body 2 (last six), [moment about the world's origin;
  // force], and their derivatives by pose.
  Vector12 wrenches;
  Matrix12 wrenches_by_pose;
  // False where the derivatives do not exist (no S or T at the contact point); then they are not finite.
  bool exist = true;
};

// `kinematics` and `separation` (contacts of two surfaces; else null) belong to the two frames' poses and twists;
// `forces` are the row forces of this contact.
RowDerivatives ComputeRowDerivatives(const TreeContact& contact, const PairKinematics& kinematics,
                                     const Separation* separation, const FrameMotion& body_1, const FrameMotion& body_2,
                                     const Baumgarte& baumgarte, const Eigen::Ref<const VectorX>& forces);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_ROW_DERIVATIVES_H_
