#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_FORCE_SHARES_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_FORCE_SHARES_H_

#include <memory>

#include "core/ocp/point_function.h"

namespace rollgait {

// Active contacts of one rigid link share the force along x in proportion to their normal forces:
//   |f_x,k Σ f_n − f_n,k Σ f_x| ≤ kWidth (m g)²,   N², one row for every contact of a link but the first.
// Without it the forces along the line that joins two contacts were free, since the motion does not depend on them.
// But for the width this division is unique, and it is continuous where a contact is taken up or given up without
// force. In the plane it is within the friction cones wherever any division is. In space so it is if the contacts have
// the same ratio of lateral to normal force; else it may leave a cone while another division does not, and the problem
// admits somewhat less than the ground does. The width is for where one contact bears nothing while another is at the
// edge of its cone: an equation would then depend on the rows of the cone, and its multiplier had no limit. Source:
// docs/explanation/contact_changes.md.
class ForceSharesConstraint : public PointConstraint {
 public:
  static constexpr double kWidth = 1e-5;

  // One contact's share among all of its link: offsets of f_x and f_n relative to PointLayout::force().
  struct Share {
    int own;  // index in the group
    std::vector<int> along, normal;
    std::string name;
  };
  ForceSharesConstraint(std::vector<Share> shares, const PointLayout& layout, double force_size)
      : shares_(std::move(shares)), layout_(layout), force_size_(force_size) {}
  int rows() const override { return static_cast<int>(shares_.size()); }
  std::string Name(int row) const override { return "share of the force along x " + shares_[row].name; }
  std::string Unit(int) const override { return "N²"; }
  double Size(int) const override { return force_size_ * force_size_; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  std::vector<Share> shares_;
  PointLayout layout_;
  double force_size_;
};

// For the active contacts of a phase; null if no two of them are on one link.
std::unique_ptr<PointConstraint> MakeForceShares(const std::vector<ContactSurface>& contacts,
                                                 const std::vector<ActiveContact>& active, const PointLayout& layout,
                                                 double force_size);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_FORCE_SHARES_H_
