// The mass matrix of TreeDynamics, its factorisation along the branches of the tree, and forward dynamics.

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

void TreeDynamics::FactoriseMass() {
  if (!has_composites_) UpdateInertias();
  for (int k = 0; k < n_; ++k) {
    const Vector6 u = composite_[k].inertia * axis_[k];
    double* row = factor_.row(k).data();
    for (int m = k; m >= 0; m = joints_[m].parent) row[m] = u.dot(axis_[m]);
  }
  for (int k = n_ - 1; k >= 0; --k) {
    double* pivot = factor_.row(k).data();
    const double inverse = 1 / pivot[k];
    for (int i = joints_[k].parent; i >= 0; i = joints_[i].parent) {
      const double ratio = pivot[i] * inverse;
      double* row = factor_.row(i).data();
      for (int j = i; j >= 0; j = joints_[j].parent) row[j] -= ratio * pivot[j];
      pivot[i] = ratio;
    }
  }
}

void TreeDynamics::SolveMass(double* x) const {
  for (int i = n_ - 1; i >= 0; --i) {
    const double* row = factor_.row(i).data();
    for (int j = joints_[i].parent; j >= 0; j = joints_[j].parent) x[j] -= row[j] * x[i];
  }
  for (int i = 0; i < n_; ++i) {
    const double* row = factor_.row(i).data();
    x[i] /= row[i];
    for (int j = joints_[i].parent; j >= 0; j = joints_[j].parent) x[i] -= row[j] * x[j];
  }
}

void TreeDynamics::SolveMassRows(RowMajorMatrix& x) const {
  for (int i = n_ - 1; i >= 0; --i) {
    const double* row = factor_.row(i).data();
    for (int j = joints_[i].parent; j >= 0; j = joints_[j].parent) x.row(j) -= row[j] * x.row(i);
  }
  for (int i = 0; i < n_; ++i) {
    const double* row = factor_.row(i).data();
    x.row(i) *= 1 / row[i];
    for (int j = joints_[i].parent; j >= 0; j = joints_[j].parent) x.row(i) -= row[j] * x.row(j);
  }
}

void TreeDynamics::ForwardDynamics(const double* q, const double* v, const double* tau, const Vector3& gravity,
                                   double* a) {
  scratch_.setZero();
  Update(q, v, scratch_.data(), gravity);
  InverseDynamics(a);
  for (int i = 0; i < n_; ++i) a[i] = tau[i] - a[i];
  FactoriseMass();
  SolveMass(a);
}

}  // namespace rollgait
