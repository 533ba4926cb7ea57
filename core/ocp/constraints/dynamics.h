#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_DYNAMICS_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_DYNAMICS_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// Equations of motion, implicit:  M(q) a + b(q, v) − Sᵀ τ − Σ J_kᵀ f_k = 0, n rows.  Source: eq. (3.8).
class DynamicsConstraint : public PointConstraint {
 public:
  // force_size (N) and effort_size (N m) scale rows of prismatic and revolute joints.
  DynamicsConstraint(const Model& model, const std::vector<ContactSurface>& contacts, std::vector<ActiveContact> active,
                     const PointLayout& layout, double force_size, double effort_size);

  int rows() const override { return layout_.n; }
  std::string Name(int row) const override;
  std::string Unit(int row) const override;
  double Size(int row) const override;
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  Vector3 Force(const PointContext& at, const ActiveContact& active) const;

  const Model& model_;
  std::vector<ActiveContact> active_;
  std::vector<std::vector<int>> paths_;
  PointLayout layout_;
  double force_size_, effort_size_;
  std::vector<ContactDerivatives<double>::Field> fields_;
  VectorX path_lambda_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_DYNAMICS_H_
