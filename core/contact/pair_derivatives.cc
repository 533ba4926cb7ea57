#include "core/contact/pair_derivatives.h"

#include <utility>

#include "core/base/check.h"
#include "core/contact/pair_expansion.h"
#include "core/multibody/spatial.h"

namespace rollgait {
namespace {

void Store(const Vector3& value, int k, int l, std::array<Matrix12, 3>* second) {
  for (int i = 0; i < 3; ++i) (*second)[i](k, l) = (*second)[i](l, k) = value[i];
}

void MarkMissing(int asked, PairDerivatives* result) {
  if (result->order < 1) {
    result->normal = result->p_1 = result->p_2 = Matrix3x12::Constant(kInfinity);
    result->gap.setConstant(kInfinity);
  }
  if (asked == 2 && result->order < 2) {
    const Matrix12 missing = Matrix12::Constant(kInfinity);
    result->normal_second.fill(missing);
    result->p_1_second.fill(missing);
    result->p_2_second.fill(missing);
    result->gap_second = missing;
  }
}

template <typename Expansion>
std::array<Change<double>, 12> FirstChanges(const Expansion& expansion, PairDerivatives* result) {
  std::array<Change<double>, 12> changes;
  for (int k = 0; k < 12; ++k) {
    expansion.First(Vector12::Unit(k), &changes[k]);
    result->normal.col(k) = changes[k].normal;
    result->gap[k] = changes[k].gap;
    result->p_1.col(k) = changes[k].p_1;
    result->p_2.col(k) = changes[k].p_2;
  }
  return changes;
}

template <typename Expansion>
PairDerivatives Derivatives(const Expansion& expansion, int order) {
  ROLLGAIT_CHECK(order == 1 || order == 2);
  PairDerivatives result;
  result.order = expansion.order();
  MarkMissing(order, &result);
  if (result.order < 1) return result;
  const std::array<Change<double>, 12> changes = FirstChanges(expansion, &result);
  if (result.order < 2) return result;
  for (int k = 0; k < 12; ++k) {
    for (int l = 0; l <= k; ++l) {
      const SecondChange<double> second = expansion.Second(changes[k], changes[l]);
      Store(second.normal, k, l, &result.normal_second);
      Store(second.p_1, k, l, &result.p_1_second);
      Store(second.p_2, k, l, &result.p_2_second);
      result.gap_second(k, l) = result.gap_second(l, k) = second.gap;
    }
  }
  return result;
}

template <typename Expansion>
PairRateDerivatives RateDerivatives(const Expansion& expansion, const FrameMotion& body_1, const FrameMotion& body_2) {
  PairRateDerivatives result;
  result.first.order = expansion.order();
  MarkMissing(1, &result.first);
  result.normal_dot = result.p_dot_1 = result.p_dot_2 = Matrix3x12::Constant(kInfinity);
  if (result.first.order < 1) return result;
  const std::array<Change<double>, 12> changes = FirstChanges(expansion, &result.first);
  if (result.first.order < 2) return result;
  Vector12 twist;
  twist << body_1.v_WB, body_1.w_WB, body_2.v_WB, body_2.w_WB;
  Change<double> along;
  expansion.First(twist, &along);
  for (int k = 0; k < 12; ++k) {
    const SecondChange<double> second = expansion.Second(along, changes[k]);
    result.normal_dot.col(k) = second.normal;
    result.p_dot_1.col(k) = second.p_1;
    result.p_dot_2.col(k) = second.p_2;
  }
  // The twist follows the turn: exp(ω t) exp(θ s) = exp(ω t + θ s + ½ t s ω × θ + …).
  const PairDerivatives& first = result.first;
  for (const auto& [column, omega] : {std::pair(3, &body_1.w_WB), std::pair(9, &body_2.w_WB)}) {
    const Matrix3 bracket = 0.5 * Skew(*omega);
    result.normal_dot.middleCols<3>(column) += first.normal.middleCols<3>(column) * bracket;
    result.p_dot_1.middleCols<3>(column) += first.p_1.middleCols<3>(column) * bracket;
    result.p_dot_2.middleCols<3>(column) += first.p_2.middleCols<3>(column) * bracket;
  }
  return result;
}

}  // namespace

PairDerivatives ComputeSurfacePairDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                              const PlacedSurface& surface_2, const FrameMotion& body_2,
                                              const Separation& separation, int order) {
  return Derivatives(SurfaceExpansion<double>(surface_1, body_1, surface_2, body_2, separation, order), order);
}

PairDerivatives ComputePlaneDerivatives(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                        const FrameMotion& plane_frame, int order) {
  return Derivatives(PlaneExpansion<double>(surface, body, plane, plane_frame, order), order);
}

PairRateDerivatives ComputeSurfacePairRateDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                                      const PlacedSurface& surface_2, const FrameMotion& body_2,
                                                      const Separation& separation) {
  return RateDerivatives(SurfaceExpansion<double>(surface_1, body_1, surface_2, body_2, separation, 2), body_1, body_2);
}

PairRateDerivatives ComputePlaneRateDerivatives(const PlacedSurface& surface, const FrameMotion& body,
                                                const PlacedPlane& plane, const FrameMotion& plane_frame) {
  return RateDerivatives(PlaneExpansion<double>(surface, body, plane, plane_frame, 2), body, plane_frame);
}

SlipDerivatives ComputeSlipDerivatives(bool on_plane, const PairKinematics& kinematics, const FrameMotion& body_1,
                                       const FrameMotion& body_2, const PairRateDerivatives& rates) {
  const Vector3& p_2 = on_plane ? kinematics.p_1 : kinematics.p_2;
  const Vector3& p_dot_2 = on_plane ? kinematics.p_dot_1 : kinematics.p_dot_2;
  const Matrix3x12& p_2_rate = on_plane ? rates.p_dot_1 : rates.p_dot_2;
  const Matrix3 w_1 = Skew(body_1.w_WB), w_2 = Skew(body_2.w_WB);
  SlipDerivatives result;
  Matrix3x12 &lever_1 = result.lever_1, &lever_2 = result.lever_2;
  lever_1 = rates.first.p_1;
  lever_1.leftCols<3>() -= Matrix3::Identity();
  lever_2 = on_plane ? rates.first.p_1 : rates.first.p_2;
  lever_2.middleCols<3>(6) -= Matrix3::Identity();
  // w = v_1 + ω_1 × r_1 − …,  ẇ = a_1 + α_1 × r_1 + ω_1 × ṙ_1 − …
  result.slip_by_pose = w_1 * lever_1 - w_2 * lever_2;
  result.slip_by_twist << Matrix3::Identity(), -Skew(kinematics.p_1 - body_1.p_WB), -Matrix3::Identity(),
      Skew(p_2 - body_2.p_WB);
  result.drift_by_pose =
      Skew(body_1.alpha_WB) * lever_1 - Skew(body_2.alpha_WB) * lever_2 + w_1 * rates.p_dot_1 - w_2 * p_2_rate;
  result.drift_by_twist = result.slip_by_pose;
  result.drift_by_twist.middleCols<3>(3) -= Skew(kinematics.p_dot_1 - body_1.v_WB);
  result.drift_by_twist.rightCols<3>() += Skew(p_dot_2 - body_2.v_WB);
  return result;
}

}  // namespace rollgait
