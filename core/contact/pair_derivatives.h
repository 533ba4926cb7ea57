#ifndef ROLLGAIT_CORE_CONTACT_PAIR_DERIVATIVES_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_DERIVATIVES_H_

#include <array>

#include "core/contact/surface_pair.h"

namespace rollgait {

using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using RowVector12 = Eigen::Matrix<double, 1, 12>;

// Derivatives of contact points, normal and gap of PairKinematics with respect to the configuration of the two frames,
//   ζ = (δp_1, δθ_1, δp_2, δθ_2):  p_WB += δp,  R_WB ← exp([δθ]) R_WB,  world axes (m, rad).
// Velocities are linear in the twists with the same matrices: with ξ = (v_1, w_1, v_2, w_2), p_dot_1 = p_1 ξ and so on.
// d(p_1 ξ)/dt along constant twists is p_1_second[ξ, ξ]. Slip, drift and rates: below to first, pair_hessians.h to
// second order. Source: contact-math 6, 8: the linear system for the normal is differentiated, never the iterations
// that found it.
struct PairDerivatives {
  Matrix3x12 normal, p_1, p_2;
  RowVector12 gap;
  // Second derivatives: one symmetric matrix per component, along exp(θ) (the Hessian in exponential coordinates at θ =
  // 0).
  std::array<Matrix12, 3> normal_second, p_1_second, p_2_second;
  Matrix12 gap_second;
  // The highest order (0, 1, 2) that exists: first derivatives need S, second T (SupportJet::order). Matrices above it,
  // up to the order asked for, are infinite; those above that are not set.
  int order = 0;
};

// `order` 1 or 2: what is wanted; 2 costs T and 78 products. Contract: `separation` belongs to the frames' poses.
PairDerivatives ComputeSurfacePairDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                              const PlacedSurface& surface_2, const FrameMotion& body_2,
                                              const Separation& separation, int order);
PairDerivatives ComputePlaneDerivatives(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                        const FrameMotion& plane_frame, int order);

// Derivatives with respect to ζ of the rates of PairKinematics while the twists ξ of the two frames (world axes, at
// their origins) keep their values, as the linearisation of a drift needs them: ∂(p_1 ξ)/∂ζ_k = p_1_second[ξ, e_k] +
// ½ p_1 [ω × θ_k], the second term because a twist in world axes does not turn with the body. By ξ they are `first`.
struct PairRateDerivatives {
  PairDerivatives first;                    // of order 1 only
  Matrix3x12 normal_dot, p_dot_1, p_dot_2;  // infinite where T does not exist (first.order < 2)
};

PairRateDerivatives ComputeSurfacePairRateDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                                      const PlacedSurface& surface_2, const FrameMotion& body_2,
                                                      const Separation& separation);
PairRateDerivatives ComputePlaneRateDerivatives(const PlacedSurface& surface, const FrameMotion& body,
                                                const PlacedPlane& plane, const FrameMotion& plane_frame);

// Derivatives of slip and drift (PairKinematics) by ζ at constant twists and accelerations, and by the twists ξ. r_i
// goes from the origin of frame i to its material point at the contact (plane: the one at p_1).
struct SlipDerivatives {
  Matrix3x12 lever_1, lever_2;             // ∂r_i/∂ζ, which are ∂ṙ_i/∂ξ, too
  Matrix3x12 slip_by_pose, slip_by_twist;  // the latter is also ∂(drift)/∂(accelerations a_1, alpha_1, a_2, alpha_2)
  Matrix3x12 drift_by_pose, drift_by_twist;
};

// `kinematics` and `rates` belong to the two frames.
SlipDerivatives ComputeSlipDerivatives(bool on_plane, const PairKinematics& kinematics, const FrameMotion& body_1,
                                       const FrameMotion& body_2, const PairRateDerivatives& rates);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_DERIVATIVES_H_
