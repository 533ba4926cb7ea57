#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_ROLLING_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_ROLLING_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// The material point at the contact is at rest:  w(q, v) = J(q) v = 0, one row per direction, m/s.  Source: eq. (2.3).
class RollingVelocityConstraint : public PointConstraint {
 public:
  RollingVelocityConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                            const PointLayout& layout);
  int rows() const override { return static_cast<int>(surface_.directions.size()); }
  std::string Name(int row) const override;
  std::string Unit(int) const override { return "m/s"; }
  double Size(int) const override { return 1; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  void UpdateField(const PointContext& at);
  ContactSurface surface_;
  int contact_;
  PointLayout layout_;
  std::vector<int> path_;
  ContactDerivatives<double>::Field field_;
  VectorX path_v_;
};

// The same on acceleration level,  d/dt w = J a + γ(q, v) = 0, m/s², for a first point that is a node of which the
// velocity is at rest already (Lobatto schemes). All derivatives come from those of w carried along (v, a).  Source:
// eq. (3.5).
class RollingAccelerationConstraint : public PointConstraint {
 public:
  RollingAccelerationConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                                const PointLayout& layout);
  int rows() const override { return static_cast<int>(surface_.directions.size()); }
  std::string Name(int row) const override;
  std::string Unit(int) const override { return "m/s²"; }
  double Size(int) const override { return 10; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  void UpdateField(const PointContext& at);
  ContactSurface surface_;
  int contact_;
  PointLayout layout_;
  std::vector<int> path_;
  ContactDerivatives<Dual>::Field field_;
  std::vector<Dual> path_u_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_ROLLING_H_
