// The mass matrix of TreeDynamics, and forward dynamics.

#include "core/multibody/tree_dynamics.h"

namespace rollgait {

void TreeDynamics::MassMatrix(const double* q, Eigen::Ref<MatrixX> mass) {
  for (int i = 0; i < n_; ++i) UpdatePose(i, q[i]);
  has_forces_ = has_composites_ = false;
  UpdateInertias();
  for (int k = 0; k < n_; ++k) {
    const Vector6 u = composite_[k].inertia * axis_[k];
    for (int m = k; m >= 0; m = joints_[m].parent) mass(m, k) = mass(k, m) = u.dot(axis_[m]);
  }
}

void TreeDynamics::ForwardDynamics(const double* q, const double* v, const double* tau, const Vector3& gravity,
                                   double* a) {
  scratch_.setZero();
  Update(q, v, scratch_.data(), gravity);
  InverseDynamics(a);
  for (int i = 0; i < n_; ++i) a[i] = tau[i] - a[i];
  if (!has_composites_) UpdateInertias();
  for (int k = 0; k < n_; ++k) {
    const Vector6 u = composite_[k].inertia * axis_[k];
    double* entry = factor_.row(k) + factor_.path_length(k);
    for (int m = k; m >= 0; m = joints_[m].parent) *--entry = u.dot(axis_[m]);
  }
  factor_.Factorise();
  factor_.SolveTransposed(a, 1, 1);
  factor_.Solve(a, 1, 1);
}

}  // namespace rollgait
