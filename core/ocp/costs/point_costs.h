#ifndef ROLLGAIT_CORE_OCP_COSTS_POINT_COSTS_H_
#define ROLLGAIT_CORE_OCP_COSTS_POINT_COSTS_H_

#include <optional>
#include <vector>

#include "core/ocp/cost_context.h"
#include "core/ocp/cost_description.h"
#include "core/ocp/costs/power_price.h"

namespace rollgait {
namespace cost {

// As requested: see rollgait.v1.CostTerm.
struct SquaredTorque {
  JointWeights joint_weights;
};
struct MechanicalWork {
  std::optional<double> smoothing;  // W
};
struct Time {};

// Contract: what is optional is set.
CostIntegral Make(const SquaredTorque& term, const CostContext& context);
CostIntegral Make(const MechanicalWork& term, const CostContext& context);
CostIntegral Make(const Time& term, const CostContext& context);

}  // namespace cost

// Σ w_j τ_j², N² m².  Source: section 4.2 of the paper.
class SquaredTorqueCost : public PointCost {
 public:
  SquaredTorqueCost(VectorX weights, const PointLayout& layout, double effort_size);
  double Typical() const override;
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  VectorX weights_;
  PointLayout layout_;
  double effort_size_;
};

// Σ E(τ_j v_j), W: mechanical power of the joints at the price 1 in both directions (power_price.h), made smooth by ε.
class MechanicalWorkCost : public PointCost {
 public:
  MechanicalWorkCost(double smoothing, std::vector<int> actuated, const PointLayout& layout, double typical);
  double Typical() const override { return typical_; }
  Entries HessianPattern() const override;
  double Value(const PointContext& at) override;
  double Unsmoothed(const PointContext& at) override;
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override;
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override;

 private:
  PowerPrice price_;
  std::vector<int> actuated_;
  PointLayout layout_;
  double typical_;
};

// 1: the integral is the duration, s.
class TimeCost : public PointCost {
 public:
  double Typical() const override { return 1; }
  Entries HessianPattern() const override { return {}; }
  double Value(const PointContext&) override { return 1; }
  void AddGradient(const PointContext&, double, Eigen::Ref<VectorX>) override {}
  void AddHessian(const PointContext&, double, Eigen::Ref<MatrixX>) override {}
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COSTS_POINT_COSTS_H_
