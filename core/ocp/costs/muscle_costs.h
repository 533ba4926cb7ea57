#ifndef ROLLGAIT_CORE_OCP_COSTS_MUSCLE_COSTS_H_
#define ROLLGAIT_CORE_OCP_COSTS_MUSCLE_COSTS_H_

#include <optional>
#include <vector>

#include "core/ocp/cost_context.h"
#include "core/ocp/cost_description.h"
#include "core/ocp/costs/power_price.h"

namespace rollgait {

namespace cost {

// As requested: see rollgait.v1.CostTerm.
struct MuscleEffort {
  std::optional<double> exponent;
  JointWeights joint_weights;
};
struct MuscleWork {
  std::optional<double> positive_efficiency, negative_efficiency;
  std::optional<double> smoothing;  // W
  JointWeights joint_weights;
};
struct PassiveLoad {
  JointWeights joint_weights;
};
struct SquaredAcceleration {
  JointWeights joint_weights;
};

// Contract: what is optional is set.
CostIntegral Make(const MuscleEffort& term, const CostContext& context);
CostIntegral Make(const MuscleWork& term, const CostContext& context);
CostIntegral Make(const PassiveLoad& term, const CostContext& context);
CostIntegral Make(const SquaredAcceleration& term, const CostContext& context);

}  // namespace cost

// Σ w_j |m_j / S_j|^κ, dimensionless, κ ≥ 2: effort of muscles against their strength S_j.
class MuscleEffortCost : public PointCost {
 public:
  MuscleEffortCost(std::vector<MuscledJoint> joints, double exponent, const PointLayout& layout);
  double Typical() const override;
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  std::vector<MuscledJoint> joints_;  // in the order of the efforts
  double exponent_;
  PointLayout layout_;
};

// Σ w_j E(P_j), W, of the power P_j = m_j v_j of the muscles at the prices 1/η⁺ and 1/η⁻ (power_price.h): the chemical
// energy of muscles that do positive work with the efficiency η⁺ and are stretched at the price 1/η⁻ for each joule,
// P⁺/η⁺ + P⁻/η⁻.
class MuscleWorkCost : public PointCost {
 public:
  MuscleWorkCost(std::vector<MuscledJoint> joints, double positive_efficiency, double negative_efficiency,
                 double smoothing, const PointLayout& layout, double typical);
  double Typical() const override { return typical_ * price_.mean(); }
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  double Unsmoothed(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  double Power(int joint, const PointContext& at) const;

  std::vector<MuscledJoint> joints_;  // in the order of the efforts
  PowerPrice price_;
  PointLayout layout_;
  double typical_;  // W, of Σ |P_j|
};

// Σ w_j (p_j(q_j) / S_j)², dimensionless: the load on what stops the joints at the ends of their range.
class PassiveLoadCost : public PointCost {
 public:
  PassiveLoadCost(std::vector<MuscledJoint> joints, const PointLayout& layout);
  double Typical() const override;
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  std::vector<MuscledJoint> joints_;
  PointLayout layout_;
};

// Σ w_j a_j², rad²/s⁴ (m²/s⁴ for a prismatic joint), over all joints.
class SquaredAccelerationCost : public PointCost {
 public:
  SquaredAccelerationCost(VectorX weights, const PointLayout& layout);
  double Typical() const override;
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  VectorX weights_;
  PointLayout layout_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COSTS_MUSCLE_COSTS_H_
