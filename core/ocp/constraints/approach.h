#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_APPROACH_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_APPROACH_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// A surface that an impact stops came from above:  n · J(q) (v⁺ − v⁻) ≥ 0, m/s, one row, since J v⁺ = 0. On the z of a
// jump (OptimalControlProblem::JumpLayout), where v⁺ − v⁻ stands in the place of the accelerations.  Source:
// docs/explanation/contact_changes.md.
class ApproachConstraint : public PointConstraint {
 public:
  ApproachConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                     const PointLayout& layout);
  int rows() const override { return 1; }
  std::string Name(int) const override { return "approach " + name_; }
  std::string Unit(int) const override { return "m/s²"; }  // times s at a jump
  double Size(int) const override { return 1; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  void UpdateField(const PointContext& at);
  std::string name_;
  int contact_;
  PointLayout layout_;
  std::vector<int> path_;
  ContactDerivatives<double>::Field field_;
  VectorX path_change_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_APPROACH_H_
