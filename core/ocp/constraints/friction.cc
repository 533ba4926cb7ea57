#include "core/ocp/constraints/friction.h"

#include <cmath>

namespace rollgait {

FrictionConstraint::FrictionConstraint(std::string contact_name, const ActiveContact& active, const PointLayout& layout,
                                       double coefficient, double force_size)
    : contact_name_(std::move(contact_name)),
      active_(active),
      layout_(layout),
      coefficient_(active.directions.size() > 2 ? coefficient / std::sqrt(2.0) : coefficient),
      force_size_(force_size) {}

std::string FrictionConstraint::Name(int) const { return "friction " + contact_name_; }
void FrictionConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), 0.0);
  std::fill_n(upper, rows(), kInfinity);
}
Entries FrictionConstraint::JacobianPattern() const {
  Entries entries;
  const int normal = static_cast<int>(active_.directions.size()) - 1;
  for (int r = 0; r < rows(); ++r) {
    entries.emplace_back(r, Column(r / 2));
    entries.emplace_back(r, Column(normal));
  }
  return entries;
}
void FrictionConstraint::Value(const PointContext& at, double* g) {
  const int normal = static_cast<int>(active_.directions.size()) - 1;
  for (int r = 0; r < rows(); ++r) {
    g[r] = coefficient_ * at.z[Column(normal)] + (r % 2 == 0 ? 1 : -1) * at.z[Column(r / 2)];
  }
}
void FrictionConstraint::Jacobian(const PointContext&, Eigen::Ref<MatrixX> jacobian) {
  const int normal = static_cast<int>(active_.directions.size()) - 1;
  for (int r = 0; r < rows(); ++r) {
    jacobian(r, Column(normal)) = coefficient_;
    jacobian(r, Column(r / 2)) = r % 2 == 0 ? 1 : -1;
  }
}

}  // namespace rollgait
