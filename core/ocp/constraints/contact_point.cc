#include "core/ocp/constraints/contact_point.h"

namespace rollgait {
namespace {

Entries PositionEntries(const std::vector<int>& path, int q) {
  Entries entries;
  for (int j : path) entries.emplace_back(0, q + j);
  return entries;
}

Entries PositionPairs(const std::vector<int>& path, int q) {
  Entries entries;
  for (int j : path) {
    for (int k : path) entries.emplace_back(q + j, q + k);
  }
  return entries;
}

}  // namespace

GapConstraint::GapConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                             const PointLayout& layout, Kind kind, double clearance)
    : name_(contacts[contact].name), contact_(contact), layout_(layout), kind_(kind), clearance_(clearance) {
  path_ = ContactDerivatives<double>(model, contacts[contact]).path();
}
void GapConstraint::Bounds(double fraction, double* lower, double* upper) const {
  const double parabola = 4 * fraction * (1 - fraction);
  *lower = kind_ == Kind::kClearance ? parabola * parabola * parabola * clearance_ : 0;
  *upper = kind_ == Kind::kClearance ? kInfinity : 0;
}
Entries GapConstraint::JacobianPattern() const { return PositionEntries(path_, layout_.q()); }
Entries GapConstraint::HessianPattern() const { return PositionPairs(path_, layout_.q()); }
void GapConstraint::Value(const PointContext& at, double* g) { *g = (*at.contacts)[contact_].point().z(); }
void GapConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  const auto& contact = (*at.contacts)[contact_];
  for (size_t k = 0; k < path_.size(); ++k) {
    jacobian(0, layout_.q() + path_[k]) = contact.PointDerivative(static_cast<int>(k)).z();
  }
}
void GapConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  const auto& contact = (*at.contacts)[contact_];
  for (int k = 0; k < contact.path_size(); ++k) {
    for (int m = 0; m < contact.path_size(); ++m) {
      hessian(layout_.q() + path_[k], layout_.q() + path_[m]) += *lambda * contact.PointSecond(m, k).z();
    }
  }
}

SurfacePointConstraint::SurfacePointConstraint(const Model& model, const std::vector<ContactSurface>& contacts,
                                               int contact, const PointLayout& layout, double min, double max)
    : name_(contacts[contact].name),
      contact_(contact),
      layout_(layout),
      semi_axis_(contacts[contact].surface.Support(Vector3::UnitX())),
      min_(min),
      max_(max) {
  path_ = ContactDerivatives<double>(model, contacts[contact]).path();
}
void SurfacePointConstraint::Bounds(double, double* lower, double* upper) const {
  *lower = min_;
  *upper = max_;
}
Entries SurfacePointConstraint::JacobianPattern() const { return PositionEntries(path_, layout_.q()); }
Entries SurfacePointConstraint::HessianPattern() const { return PositionPairs(path_, layout_.q()); }
void SurfacePointConstraint::Value(const PointContext& at, double* g) {
  *g = (*at.contacts)[contact_].surface_point().x() / semi_axis_;
}
void SurfacePointConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  const auto& contact = (*at.contacts)[contact_];
  for (size_t k = 0; k < path_.size(); ++k) {
    jacobian(0, layout_.q() + path_[k]) = contact.SurfacePointDerivative(static_cast<int>(k)).x() / semi_axis_;
  }
}
void SurfacePointConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  const auto& contact = (*at.contacts)[contact_];
  for (int k = 0; k < contact.path_size(); ++k) {
    for (int m = 0; m < contact.path_size(); ++m) {
      hessian(layout_.q() + path_[k], layout_.q() + path_[m]) +=
          *lambda * contact.SurfacePointSecond(m, k).x() / semi_axis_;
    }
  }
}

}  // namespace rollgait
