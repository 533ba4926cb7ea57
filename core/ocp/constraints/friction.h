#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// A row  Σ coefficient · force >= 0  over the forces (or impulses) of one phase.
struct ForceRow {
  std::string name;
  std::vector<std::pair<int, double>> terms;  // (offset as in ActiveContact, coefficient)
  int contact = 0;
  bool positive = true;  // of the two rows of a tangent direction, the one with + f_t
  bool shared = false;   // along x, where another contact of the link bears a share (ForceSharesConstraint)
};

// Friction pyramids of the active contacts of a phase: for each tangent direction t of a contact  μ f_n + f_t >= 0  and
// μ f_n − f_t >= 0, in this order. In the plane the pyramid is the cone; in space it is the inner pyramid, with μ/√2,
// so that the cone holds as well. `contacts` are all of the problem; `active` those of the phase.
std::vector<ForceRow> FrictionRows(const std::vector<ContactSurface>& contacts,
                                   const std::vector<ActiveContact>& active, double coefficient);

// These rows at one instant, N or N s.
class FrictionConstraint : public PointConstraint {
 public:
  FrictionConstraint(std::vector<ForceRow> rows, const PointLayout& layout, double force_size)
      : rows_(std::move(rows)), layout_(layout), force_size_(force_size) {}
  int rows() const override { return static_cast<int>(rows_.size()); }
  std::string Name(int row) const override { return rows_[row].name; }
  std::string Unit(int) const override { return "N"; }
  double Size(int) const override { return force_size_; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override { return {}; }
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext&, const double*, Eigen::Ref<MatrixX>) override {}

 private:
  std::vector<ForceRow> rows_;
  PointLayout layout_;
  double force_size_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_
