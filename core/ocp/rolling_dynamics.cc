#include "core/ocp/rolling_dynamics.h"

#include <utility>

#include "core/base/check.h"

namespace rollgait {

RollingDynamics::RollingDynamics(const Model& model, std::vector<ContactSurface> active)
    : n_(model.size()), tree_(model) {
  for (ContactSurface& surface : active) {
    ContactDerivatives<Dual> along(model, surface);
    Contact contact{std::move(surface), rows_, along, along.MakeField(), {}};
    contact.path_u.resize(contact.along.path().size());
    rows_ += static_cast<int>(contact.surface.directions.size());
    contacts_.push_back(std::move(contact));
  }
  q_ = v_ = acceleration_ = VectorX::Zero(n_);
  forces_ = drift_ = VectorX::Zero(rows_);
  jacobian_ = RowMajorMatrix::Zero(rows_, n_);
  response_ = RowMajorMatrix::Zero(n_, rows_);
  gram_ = MatrixX::Identity(rows_, rows_);
  mobility_.compute(MatrixX::Identity(rows_, rows_));  // takes its memory here
  dq_ = dv_ = da_ = MatrixX::Zero(n_, n_);
  d_acceleration_ = RowMajorMatrix::Zero(n_, 3 * n_);
  d_forces_ = d_rolling_ = RowMajorMatrix::Zero(rows_, 3 * n_);
}

// J and γ of one contact, from the tree at zero joint accelerations.
void RollingDynamics::AddRows(const Contact& contact, const Vector3& gravity) {
  const ContactSurface& surface = contact.surface;
  const int link = surface.joint;
  const Matrix3 R_WE = tree_.rotation(link) * surface.R_LE;
  const Vector3 nu = -R_WE.row(2).transpose();
  const Vector3 point = tree_.origin(link) + tree_.rotation(link) * surface.p_LE + R_WE * surface.surface.SupportPoint(nu);
  const Vector6 &twist = tree_.twist(link), &bias = tree_.acceleration(link);
  const Vector3 w = twist.head<3>();
  const Vector3 slip = twist.tail<3>() + w.cross(point);
  const Vector3 over_surface = R_WE * surface.surface.RollingVelocity(nu, R_WE.transpose() * w);
  // The tree's accelerations are spatial and fall with −g.
  const Vector3 drift = bias.tail<3>() + gravity + bias.head<3>().cross(point) + w.cross(slip) + w.cross(over_surface);
  const int count = static_cast<int>(surface.directions.size());
  for (int d = 0; d < count; ++d) drift_(contact.first_row + d) = drift(surface.directions[d]);
  for (int j : contact.along.path()) {
    const Vector6& axis = tree_.axis(j);
    const Vector3 column = axis.tail<3>() + axis.head<3>().cross(point);
    for (int d = 0; d < count; ++d) jacobian_(contact.first_row + d, j) = column(surface.directions[d]);
  }
}

void RollingDynamics::Evaluate(const double* q, const double* v, const double* tau, const Vector3& gravity) {
  q_ = Eigen::Map<const VectorX>(q, n_);
  v_ = Eigen::Map<const VectorX>(v, n_);
  gravity_ = gravity;
  tree_.ForwardDynamics(q, v, tau, gravity, acceleration_.data());
  if (rows_ == 0) return;
  for (const Contact& contact : contacts_) AddRows(contact, gravity);
  response_ = jacobian_.transpose();
  tree_.SolveMassRows(response_);
  gram_.noalias() = jacobian_ * response_;
  mobility_.compute(gram_);
  ROLLGAIT_CHECK(mobility_.info() == Eigen::Success);
  forces_.noalias() = jacobian_ * acceleration_;
  forces_ = -(forces_ + drift_);
  mobility_.solveInPlace(forces_);
  acceleration_.noalias() += response_ * forces_;
}

// d_acceleration_ gets + ∂(Jᵀf)/∂q, d_rolling_ the derivative of ẇ = J a + γ at fixed a.
void RollingDynamics::AddContactDerivatives(Contact& contact) {
  ContactDerivatives<Dual>& along = contact.along;
  along.Update(tree_);
  const std::vector<int>& path = along.path();
  for (size_t k = 0; k < path.size(); ++k) contact.path_u[k] = Dual(v_(path[k]), acceleration_(path[k]));
  along.ComputeField(contact.path_u.data(), &contact.field);
  const std::vector<int>& directions = contact.surface.directions;
  const int count = static_cast<int>(directions.size());
  for (int k = 0; k < along.path_size(); ++k) {
    const auto column = along.JacobianColumn(k);
    for (int d = 0; d < count; ++d) {
      const Dual& gradient = contact.field.gradient[k](directions[d]);
      d_rolling_(contact.first_row + d, path[k]) = gradient.d;
      d_rolling_(contact.first_row + d, n_ + path[k]) = column(directions[d]).d + gradient.v;
    }
    for (int m = 0; m < along.path_size(); ++m) {
      const auto turned = along.JacobianDerivative(m, k);
      double sum = 0;
      for (int d = 0; d < count; ++d) sum += forces_(contact.first_row + d) * turned(directions[d]).v;
      d_acceleration_(path[k], path[m]) += sum;
    }
  }
}

void RollingDynamics::Differentiate() {
  tree_.Update(q_.data(), v_.data(), acceleration_.data(), gravity_);
  tree_.FirstDerivatives(dq_, dv_, da_);
  d_acceleration_.leftCols(n_) = -dq_;
  d_acceleration_.middleCols(n_, n_) = -dv_;
  d_acceleration_.rightCols(n_).setIdentity();
  for (Contact& contact : contacts_) AddContactDerivatives(contact);
  tree_.SolveMassRows(d_acceleration_);
  if (rows_ == 0) return;
  d_forces_.noalias() = -jacobian_ * d_acceleration_;
  d_forces_ -= d_rolling_;
  mobility_.solveInPlace(d_forces_);
  d_acceleration_.noalias() += response_ * d_forces_;
}

}  // namespace rollgait
