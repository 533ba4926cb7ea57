#include "core/ocp/constraints/approach.h"

namespace rollgait {

ApproachConstraint::ApproachConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                                       const PointLayout& layout)
    : name_(contacts[contact].name), contact_(contact), layout_(layout) {
  const ContactDerivatives<double> derivatives(model, contacts[contact]);
  path_ = derivatives.path();
  field_ = derivatives.MakeField();
  path_change_.resize(static_cast<int>(path_.size()));
}

void ApproachConstraint::Bounds(double, double* lower, double* upper) const {
  *lower = 0;
  *upper = kInfinity;
}
Entries ApproachConstraint::JacobianPattern() const {
  Entries entries;
  for (int block : {layout_.q(), layout_.a()}) {
    for (int j : path_) entries.emplace_back(0, block + j);
  }
  return entries;
}
Entries ApproachConstraint::HessianPattern() const {
  Entries entries;
  for (int block : {layout_.q(), layout_.a()}) {
    for (int j : path_) {
      for (int k : path_) entries.emplace_back(layout_.q() + j, block + k);
    }
  }
  return entries;
}

void ApproachConstraint::UpdateField(const PointContext& at) {
  for (size_t k = 0; k < path_.size(); ++k) path_change_(static_cast<int>(k)) = at.z[layout_.a() + path_[k]];
  (*at.contacts)[contact_].ComputeField(path_change_.data(), &field_);
}
void ApproachConstraint::Value(const PointContext& at, double* g) {
  UpdateField(at);
  *g = (*at.contacts)[contact_].Velocity(field_).z();
}
void ApproachConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  UpdateField(at);
  const auto& contact = (*at.contacts)[contact_];
  for (size_t k = 0; k < path_.size(); ++k) {
    jacobian(0, layout_.q() + path_[k]) = field_.gradient[k].z();
    jacobian(0, layout_.a() + path_[k]) = contact.JacobianColumn(static_cast<int>(k)).z();
  }
}
void ApproachConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  UpdateField(at);
  const auto& contact = (*at.contacts)[contact_];
  const Vector3 y = *lambda * Vector3::UnitZ();
  const int size = contact.path_size(), q = layout_.q(), a = layout_.a();
  for (int k = 0; k < size; ++k) {
    for (int m = 0; m < size; ++m) {
      hessian(q + path_[m], a + path_[k]) += y.dot(contact.JacobianDerivative(m, k));
      hessian(q + path_[m], q + path_[k]) += contact.ContractedSecond(field_, y, std::min(m, k), std::max(m, k));
    }
  }
}

}  // namespace rollgait
