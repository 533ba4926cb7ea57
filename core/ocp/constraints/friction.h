#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_FRICTION_H_

#include "core/ocp/added_constraints.h"
#include "core/ocp/point_function.h"

namespace rollgait {

// A side of a friction pyramid, between two neighbouring edges: directions in steps of 5° from x towards y, `from` in
// 0 … 71, `to` up to 72. In the plane there are no sides between edges: from = to is the one direction in which the
// tangential force is bounded, 0 (+x) or 36 (−x).
struct FrictionSide {
  int from = 0, to = 0;
  double middle() const;      // rad
  double half_width() const;  // rad
};

// A row  Σ coefficient · force >= 0  over the forces (or impulses) of one phase.
struct ForceRow {
  std::string name;
  std::vector<std::pair<int, double>> terms;  // (offset as in ActiveContact, coefficient)
  int contact = 0;
  FrictionSide side;
  // Where the normal force of the contact is 0, its rows that are `independent` say as equations that the tangential
  // forces are 0, and its other rows say nothing. `shared`: of the independent rows the one along x, of a contact whose
  // link has another that bears a share of that force (ForceSharesConstraint).
  bool independent = false, shared = false;
};

// The edges of the pyramid of a contact in space, ascending: every 45°, and those of `added` that are of the contact.
std::vector<int> FrictionDirections(int contact, const std::vector<FrictionEdge>& added);

// Friction of the active contacts of a phase. In space the cone |f_t| <= μ f_n is replaced by the pyramid with the
// edges of FrictionDirections. They lie on the cone, f_t = μ f_n (cos a, sin a), so that the pyramid is within it; the
// row of the side between the neighbouring edges a < b is
//   μ f_n cos((b − a)/2) − f_x cos((a + b)/2) − f_y sin((a + b)/2) >= 0.
// Between edges 45° apart a side is at most 7.6 % of μ f_n within the cone. In the plane the rows are the cone:
// μ f_n + f_x >= 0 and μ f_n − f_x >= 0, in this order. `contacts` are all of the problem; `active` those of the phase.
std::vector<ForceRow> FrictionRows(const std::vector<ContactSurface>& contacts,
                                   const std::vector<ActiveContact>& active, double coefficient,
                                   const std::vector<FrictionEdge>& added = {});

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
