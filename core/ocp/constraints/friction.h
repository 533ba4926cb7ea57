#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// Friction pyramid of one active contact, N: for each tangent direction t,  μ f_n + f_t ≥ 0  and  μ f_n − f_t ≥ 0. In the
// plane it is the cone; in space it is the inner pyramid, with μ/√2, so that the cone holds as well.
class FrictionConstraint : public PointConstraint {
 public:
  FrictionConstraint(std::string contact_name, const ActiveContact& active, const PointLayout& layout,
                     double coefficient, double force_size);
  int rows() const override { return 2 * (static_cast<int>(active_.directions.size()) - 1); }
  std::string Name(int row) const override;
  std::string Unit(int) const override { return "N"; }
  double Size(int) const override { return force_size_; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override { return {}; }
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext&, const double*, Eigen::Ref<MatrixX>) override {}

 private:
  int Column(int direction) const { return layout_.force() + active_.offset + direction; }
  std::string contact_name_;
  ActiveContact active_;
  PointLayout layout_;
  double coefficient_, force_size_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_
