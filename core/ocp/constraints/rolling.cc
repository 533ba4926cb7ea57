#include "core/ocp/constraints/rolling.h"

namespace rollgait {
namespace {

constexpr const char* kDirectionNames[] = {"x", "y", "z"};

// Multipliers of the rows as a world vector.
template <typename T>
Eigen::Matrix<T, 3, 1> WorldVector(const std::vector<int>& directions, const double* values) {
  Eigen::Matrix<T, 3, 1> y = Eigen::Matrix<T, 3, 1>::Zero();
  for (size_t d = 0; d < directions.size(); ++d) y(directions[d]) = values[d];
  return y;
}

// Every row against every joint on the path, in the given blocks.
Entries PathEntries(int rows, const std::vector<int>& path, const std::vector<int>& blocks) {
  Entries entries;
  for (int r = 0; r < rows; ++r) {
    for (int block : blocks) {
      for (int j : path) entries.emplace_back(r, block + j);
    }
  }
  return entries;
}

// Every joint on the path against every other, in the given pairs of blocks.
Entries PathPairs(const std::vector<int>& path, const std::vector<std::pair<int, int>>& blocks) {
  Entries entries;
  for (const auto& [first, second] : blocks) {
    for (int j : path) {
      for (int k : path) entries.emplace_back(first + j, second + k);
    }
  }
  return entries;
}

}  // namespace

RollingVelocityConstraint::RollingVelocityConstraint(const Model& model, const std::vector<ContactSurface>& contacts,
                                                     int contact, const PointLayout& layout)
    : surface_(contacts[contact]), contact_(contact), layout_(layout) {
  const ContactDerivatives<double> derivatives(model, surface_);
  path_ = derivatives.path();
  field_ = derivatives.MakeField();
  path_v_.resize(static_cast<int>(path_.size()));
}

std::string RollingVelocityConstraint::Name(int row) const {
  return "rolling " + surface_.name + " " + kDirectionNames[surface_.directions[row]];
}
void RollingVelocityConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), 0.0);
  std::fill_n(upper, rows(), 0.0);
}
Entries RollingVelocityConstraint::JacobianPattern() const {
  return PathEntries(rows(), path_, {layout_.q(), layout_.v()});
}
Entries RollingVelocityConstraint::HessianPattern() const {
  return PathPairs(path_, {{layout_.q(), layout_.q()}, {layout_.q(), layout_.v()}});
}

void RollingVelocityConstraint::UpdateField(const PointContext& at) {
  for (size_t k = 0; k < path_.size(); ++k) path_v_(static_cast<int>(k)) = at.z[layout_.v() + path_[k]];
  (*at.contacts)[contact_].ComputeField(path_v_.data(), &field_);
}

void RollingVelocityConstraint::Value(const PointContext& at, double* g) {
  UpdateField(at);
  const Vector3 w = (*at.contacts)[contact_].Velocity(field_);
  for (int r = 0; r < rows(); ++r) g[r] = w(surface_.directions[r]);
}

void RollingVelocityConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  UpdateField(at);
  const auto& contact = (*at.contacts)[contact_];
  for (size_t k = 0; k < path_.size(); ++k) {
    const Vector3 column = contact.JacobianColumn(static_cast<int>(k));
    for (int r = 0; r < rows(); ++r) {
      jacobian(r, layout_.q() + path_[k]) = field_.gradient[k](surface_.directions[r]);
      jacobian(r, layout_.v() + path_[k]) = column(surface_.directions[r]);
    }
  }
}

void RollingVelocityConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  UpdateField(at);
  const auto& contact = (*at.contacts)[contact_];
  const Vector3 y = WorldVector<double>(surface_.directions, lambda);
  const int size = contact.path_size(), q = layout_.q(), v = layout_.v();
  for (int k = 0; k < size; ++k) {
    for (int m = 0; m < size; ++m) hessian(q + path_[m], v + path_[k]) += y.dot(contact.JacobianDerivative(m, k));
    for (int m = 0; m <= k; ++m) {
      const double second = contact.ContractedSecond(field_, y, m, k);
      hessian(q + path_[k], q + path_[m]) += second;
      if (m != k) hessian(q + path_[m], q + path_[k]) += second;
    }
  }
}

RollingAccelerationConstraint::RollingAccelerationConstraint(const Model& model,
                                                             const std::vector<ContactSurface>& contacts, int contact,
                                                             const PointLayout& layout)
    : surface_(contacts[contact]), contact_(contact), layout_(layout) {
  const ContactDerivatives<Dual> derivatives(model, surface_);
  path_ = derivatives.path();
  field_ = derivatives.MakeField();
  path_u_.resize(path_.size());
}

std::string RollingAccelerationConstraint::Name(int row) const {
  return "rolling acceleration " + surface_.name + " " + kDirectionNames[surface_.directions[row]];
}
void RollingAccelerationConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), 0.0);
  std::fill_n(upper, rows(), 0.0);
}
Entries RollingAccelerationConstraint::JacobianPattern() const {
  return PathEntries(rows(), path_, {layout_.q(), layout_.v(), layout_.a()});
}
Entries RollingAccelerationConstraint::HessianPattern() const {
  const int q = layout_.q(), v = layout_.v(), a = layout_.a();
  return PathPairs(path_, {{q, q}, {q, v}, {q, a}, {v, v}});
}

void RollingAccelerationConstraint::UpdateField(const PointContext& at) {
  for (size_t k = 0; k < path_.size(); ++k) {
    path_u_[k] = Dual(at.z[layout_.v() + path_[k]], at.z[layout_.a() + path_[k]]);
  }
  (*at.dual_contacts)[contact_].ComputeField(path_u_.data(), &field_);
}

void RollingAccelerationConstraint::Value(const PointContext& at, double* g) {
  UpdateField(at);
  const auto w = (*at.dual_contacts)[contact_].Velocity(field_);
  for (int r = 0; r < rows(); ++r) g[r] = w(surface_.directions[r]).d;
}

void RollingAccelerationConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  UpdateField(at);
  const auto& contact = (*at.dual_contacts)[contact_];
  for (size_t k = 0; k < path_.size(); ++k) {
    const auto column = contact.JacobianColumn(static_cast<int>(k));
    for (int r = 0; r < rows(); ++r) {
      const int d = surface_.directions[r];
      jacobian(r, layout_.q() + path_[k]) = field_.gradient[k](d).d;
      jacobian(r, layout_.v() + path_[k]) = column(d).d + field_.gradient[k](d).v;
      jacobian(r, layout_.a() + path_[k]) = column(d).v;
    }
  }
}

void RollingAccelerationConstraint::AddHessian(const PointContext& at, const double* lambda,
                                               Eigen::Ref<MatrixX> hessian) {
  UpdateField(at);
  const auto& contact = (*at.dual_contacts)[contact_];
  const auto y = WorldVector<Dual>(surface_.directions, lambda);
  const int size = contact.path_size(), q = layout_.q(), v = layout_.v(), a = layout_.a();
  for (int k = 0; k < size; ++k) {
    for (int m = 0; m < size; ++m) {
      const Dual second = contact.ContractedSecond(field_, y, m, k);
      const Dual mixed = y.dot(contact.JacobianDerivative(m, k));  // ∂²/∂q_m ∂u_k
      hessian(q + path_[m], q + path_[k]) += second.d;
      hessian(q + path_[m], v + path_[k]) += mixed.d + second.v;
      hessian(q + path_[m], a + path_[k]) += mixed.v;
      hessian(v + path_[m], v + path_[k]) += mixed.v;
      hessian(v + path_[k], v + path_[m]) += mixed.v;
    }
  }
}

}  // namespace rollgait
