#include "core/ocp/constraints/dynamics.h"

namespace rollgait {

DynamicsConstraint::DynamicsConstraint(const Model& model, const std::vector<ContactSurface>& contacts,
                                       std::vector<ActiveContact> active, const PointLayout& layout, double force_size,
                                       double effort_size)
    : model_(model), active_(std::move(active)), layout_(layout), force_size_(force_size), effort_size_(effort_size) {
  for (const ActiveContact& contact : active_) {
    const ContactDerivatives<double> derivatives(model, contacts[contact.contact]);
    paths_.push_back(derivatives.path());
    fields_.push_back(derivatives.MakeField());
  }
  path_lambda_.resize(layout.n);
}

std::string DynamicsConstraint::Name(int row) const { return "dynamics " + model_.joint(row).name; }
std::string DynamicsConstraint::Unit(int row) const { return model_.joint(row).kind().effort_unit(); }
double DynamicsConstraint::Size(int row) const {
  return model_.joint(row).kind().is_slide() ? force_size_ : effort_size_;
}
void DynamicsConstraint::Bounds(double, double* lower, double* upper) const {
  std::fill_n(lower, rows(), 0.0);
  std::fill_n(upper, rows(), 0.0);
}

Entries DynamicsConstraint::JacobianPattern() const {
  Entries entries;
  const int n = layout_.n;
  for (int k = 0; k < n; ++k) {
    for (int m = 0; m < n; ++m) {
      if (!model_.Related(k, m)) continue;
      for (int block : {layout_.q(), layout_.v(), layout_.a()}) entries.emplace_back(k, block + m);
    }
  }
  for (int j = 0; j < layout_.efforts; ++j) entries.emplace_back(model_.actuated()[j], layout_.tau() + j);
  for (size_t c = 0; c < active_.size(); ++c) {
    for (int k : paths_[c]) {
      for (size_t d = 0; d < active_[c].directions.size(); ++d) {
        entries.emplace_back(k, layout_.force() + active_[c].offset + static_cast<int>(d));
      }
    }
  }
  return entries;
}

Entries DynamicsConstraint::HessianPattern() const {
  Entries entries;
  for (int k = 0; k < layout_.n; ++k) {
    for (int m = 0; m < layout_.n; ++m) {
      if (!model_.Related(k, m)) continue;
      entries.emplace_back(layout_.q() + k, layout_.q() + m);
      entries.emplace_back(layout_.q() + k, layout_.v() + m);
      entries.emplace_back(layout_.q() + k, layout_.a() + m);
      entries.emplace_back(layout_.v() + k, layout_.v() + m);
    }
  }
  for (size_t c = 0; c < active_.size(); ++c) {
    for (int k : paths_[c]) {
      for (size_t d = 0; d < active_[c].directions.size(); ++d) {
        entries.emplace_back(layout_.q() + k, layout_.force() + active_[c].offset + static_cast<int>(d));
      }
    }
  }
  return entries;
}

Vector3 DynamicsConstraint::Force(const PointContext& at, const ActiveContact& active) const {
  Vector3 force = Vector3::Zero();
  for (size_t d = 0; d < active.directions.size(); ++d) {
    force(active.directions[d]) = at.z[layout_.force() + active.offset + static_cast<int>(d)];
  }
  return force;
}

void DynamicsConstraint::Value(const PointContext& at, double* g) {
  at.tree->InverseDynamics(g);
  for (int j = 0; j < layout_.efforts; ++j) g[model_.actuated()[j]] -= at.z[layout_.tau() + j];
  for (const ActiveContact& active : active_) {
    const auto& contact = (*at.contacts)[active.contact];
    const Vector3 force = Force(at, active);
    for (int k = 0; k < contact.path_size(); ++k) g[contact.path()[k]] -= contact.JacobianColumn(k).dot(force);
  }
}

void DynamicsConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  const int n = layout_.n;
  at.tree->FirstDerivatives(jacobian.middleCols(layout_.q(), n), jacobian.middleCols(layout_.v(), n),
                            jacobian.middleCols(layout_.a(), n));
  for (int j = 0; j < layout_.efforts; ++j) jacobian(model_.actuated()[j], layout_.tau() + j) = -1;
  for (const ActiveContact& active : active_) {
    const auto& contact = (*at.contacts)[active.contact];
    const Vector3 force = Force(at, active);
    for (int k = 0; k < contact.path_size(); ++k) {
      const int row = contact.path()[k];
      for (int m = 0; m < contact.path_size(); ++m) {
        jacobian(row, layout_.q() + contact.path()[m]) -= force.dot(contact.JacobianDerivative(m, k));
      }
      const Vector3 column = contact.JacobianColumn(k);
      for (size_t d = 0; d < active.directions.size(); ++d) {
        jacobian(row, layout_.force() + active.offset + static_cast<int>(d)) = -column(active.directions[d]);
      }
    }
  }
}

void DynamicsConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  const int n = layout_.n, q = layout_.q(), v = layout_.v(), a = layout_.a();
  at.tree->AddContractedHessian(lambda, hessian.block(q, q, n, n), hessian.block(q, v, n, n), hessian.block(q, a, n, n),
                                hessian.block(v, v, n, n));
  // −λᵀ Jᵀ f = −β(q; f, λ)
  for (size_t c = 0; c < active_.size(); ++c) {
    const ActiveContact& active = active_[c];
    const auto& contact = (*at.contacts)[active.contact];
    const auto& path = contact.path();
    for (int k = 0; k < contact.path_size(); ++k) path_lambda_(k) = lambda[path[k]];
    contact.ComputeField(path_lambda_.data(), &fields_[c]);
    const Vector3 force = Force(at, active);
    for (int k = 0; k < contact.path_size(); ++k) {
      for (int m = 0; m <= k; ++m) {
        const double second = contact.ContractedSecond(fields_[c], force, m, k);
        hessian(q + path[k], q + path[m]) -= second;
        if (m != k) hessian(q + path[m], q + path[k]) -= second;
      }
      for (size_t d = 0; d < active.directions.size(); ++d) {
        hessian(q + path[k], layout_.force() + active.offset + static_cast<int>(d)) -=
            fields_[c].gradient[k](active.directions[d]);
      }
    }
  }
}

}  // namespace rollgait
