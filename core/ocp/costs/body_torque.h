#ifndef ROLLGAIT_CORE_OCP_COSTS_BODY_TORQUE_H_
#define ROLLGAIT_CORE_OCP_COSTS_BODY_TORQUE_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// |M|², N² m², of the couple M on a body whose orientation has three revolute joints in a chain, their axes
// perpendicular to one another at position zero, as a function of their efforts. By virtual power τ = Aᵀ M where ω = A
// q̇, so
//   |M|² = τᵀ (AᵀA)⁻¹ τ = (τ₁² + τ₃² − 2 sin β τ₁ τ₃) / cos²β + τ₂²,
// the same in world and in body axes. β is the middle angle; infinite at ±90°.
class BodyTorqueCost : public PointCost {
 public:
  // middle_joint: index of the second of the three joints. The efforts of the layout are those of the three.
  BodyTorqueCost(int middle_joint, const PointLayout& layout, double typical);
  double Typical() const override { return typical_; }
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  int beta_, tau_;  // where β and the first effort sit in z
  double typical_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COSTS_BODY_TORQUE_H_
