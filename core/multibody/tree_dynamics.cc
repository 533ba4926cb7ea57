#include "core/multibody/tree_dynamics.h"

#include <cmath>

namespace rollgait {
namespace {

const Vector6 kZero6 = Vector6::Zero();

// Rotation about a unit axis (Rodrigues).
Matrix3 AxisRotation(const Vector3& axis, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  Matrix3 r = (1 - c) * axis * axis.transpose();
  r.diagonal().array() += c;
  return r + s * Skew(axis);
}

}  // namespace

TreeDynamics::TreeDynamics(const Model& model) : model_(&model), n_(model.size()) {
  for (int i = 0; i < n_; ++i) {
    parent_.push_back(model.parent(i));
    has_mass_.push_back(model.joint(i).mass > 0);
  }
  rotation_.assign(n_, Matrix3::Identity());
  origin_.assign(n_, Vector3::Zero());
  axis_.assign(n_, kZero6);
  twist_ = acceleration_ = psi_ = psi2_ = virtual_twist_ = omega_ = axis_;
  link_inertia_.assign(n_, SpatialInertia());
  composite_.assign(n_, Composite());
  virtual_.assign(n_, VirtualComposite());
}

void TreeDynamics::UpdateKinematics(const double* q, const double* v) {
  for (int i = 0; i < n_; ++i) {
    const Joint& joint = model_->joint(i);
    const int p = parent_[i];
    Matrix3 R_WJ;
    Vector3 p_WJ;
    if (p < 0) {
      R_WJ = joint.R_PJ;
      p_WJ = joint.p_PJ;
    } else {
      R_WJ.noalias() = rotation_[p] * joint.R_PJ;
      p_WJ.noalias() = origin_[p] + rotation_[p] * joint.p_PJ;
    }
    const Vector3 axis_W = R_WJ * joint.axis;
    if (joint.type == JointType::kRevolute) {
      rotation_[i].noalias() = R_WJ * AxisRotation(joint.axis, q[i]);
      origin_[i] = p_WJ;
      axis_[i] << axis_W, p_WJ.cross(axis_W);
    } else {
      rotation_[i] = R_WJ;
      origin_[i] = p_WJ + q[i] * axis_W;
      axis_[i] << Vector3::Zero(), axis_W;
    }
    if (p < 0) {
      psi_[i].setZero();
      twist_[i] = axis_[i] * v[i];
    } else {
      psi_[i] = CrossMotion(twist_[p], axis_[i]);
      twist_[i] = twist_[p] + axis_[i] * v[i];
    }
  }
}

void TreeDynamics::Update(const double* q, const double* v, const double* a, const Vector3& gravity) {
  UpdateKinematics(q, v);
  root_acceleration_ << Vector3::Zero(), -gravity;
  for (int i = 0; i < n_; ++i) {
    const int p = parent_[i];
    const Vector6& from = p < 0 ? root_acceleration_ : acceleration_[p];
    psi2_[i] = CrossMotion(from, axis_[i]);
    if (p >= 0) psi2_[i] += CrossMotion(twist_[p], psi_[i]);
    acceleration_[i] = from + axis_[i] * a[i] + psi_[i] * v[i];
  }
  UpdateComposites();
}

void TreeDynamics::UpdateComposites() {
  for (int i = 0; i < n_; ++i) {
    Composite& c = composite_[i];
    if (!has_mass_[i]) {
      c = Composite();
      link_inertia_[i] = SpatialInertia();
      continue;
    }
    const Joint& joint = model_->joint(i);
    const Matrix3& R = rotation_[i];
    const Vector3 com = origin_[i] + R * joint.center_of_mass;
    SpatialInertia& inertia = link_inertia_[i];
    inertia.mass = joint.mass;
    inertia.moment = joint.mass * com;
    inertia.rotational.noalias() = R * joint.inertia * R.transpose();
    inertia.rotational -= inertia.moment * com.transpose();
    inertia.rotational.diagonal().array() += inertia.moment.dot(com);

    const Vector6& twist = twist_[i];
    const Vector6 momentum = inertia * twist;
    c.inertia = inertia;
    c.force = inertia * acceleration_[i] + CrossForce(twist, momentum);
    c.momentum = momentum.tail<3>();
    const Matrix3 spin = Skew(twist.head<3>());
    c.coriolis.noalias() = 2 * spin * inertia.rotational - 2 * Skew(inertia.moment) * Skew(twist.tail<3>());
    c.coriolis -= inertia.rotational.trace() * spin;
  }
  for (int i = n_ - 1; i > 0; --i) {
    const int p = parent_[i];
    if (p < 0) continue;
    composite_[p].inertia += composite_[i].inertia;
    composite_[p].coriolis += composite_[i].coriolis;
    composite_[p].momentum += composite_[i].momentum;
    composite_[p].force += composite_[i].force;
  }
}

Vector6 TreeDynamics::ApplyCoriolis(const Composite& c, const Vector6& x) const {
  Vector6 y;
  y.head<3>().noalias() = c.coriolis * x.head<3>();
  y.tail<3>() = -2 * c.momentum.cross(x.head<3>());
  return y;
}

Vector6 TreeDynamics::ApplyCoriolisTranspose(const Composite& c, const Vector6& w) const {
  Vector6 y;
  y.head<3>() = c.coriolis.transpose() * w.head<3>() + 2 * c.momentum.cross(w.tail<3>());
  y.tail<3>().setZero();
  return y;
}

void TreeDynamics::InverseDynamics(double* tau) const {
  for (int i = 0; i < n_; ++i) tau[i] = axis_[i].dot(composite_[i].force);
}

void TreeDynamics::FirstDerivatives(Eigen::Ref<MatrixX> dq, Eigen::Ref<MatrixX> dv, Eigen::Ref<MatrixX> da) {
  for (int k = 0; k < n_; ++k) {
    const Composite& c = composite_[k];
    const Vector6& s = axis_[k];
    const Vector6 u = c.inertia * s;
    const Vector6 b = ApplyCoriolisTranspose(c, s);
    const Vector6 column_v = 2 * (c.inertia * psi_[k]) + ApplyCoriolis(c, s);
    const Vector6 column_q = CrossForce(s, c.force) + c.inertia * psi2_[k] + ApplyCoriolis(c, psi_[k]);
    // Row k against its ancestors and itself; column k against its proper ancestors.
    for (int m = k; m >= 0; m = parent_[m]) {
      dq(k, m) = u.dot(psi2_[m]) + b.dot(psi_[m]);
      dv(k, m) = 2 * u.dot(psi_[m]) + b.dot(axis_[m]);
      da(k, m) = u.dot(axis_[m]);
      if (m == k) continue;
      dq(m, k) = axis_[m].dot(column_q);
      dv(m, k) = axis_[m].dot(column_v);
      da(m, k) = da(k, m);
    }
  }
}

void TreeDynamics::UpdateVirtual(const double* lambda) {
  for (int i = 0; i < n_; ++i) {
    const int p = parent_[i];
    if (p < 0) {
      omega_[i].setZero();
      virtual_twist_[i] = axis_[i] * lambda[i];
    } else {
      omega_[i] = CrossMotion(virtual_twist_[p], axis_[i]);
      virtual_twist_[i] = virtual_twist_[p] + axis_[i] * lambda[i];
    }
    VirtualComposite& c = virtual_[i];
    if (!has_mass_[i]) {
      c = VirtualComposite();
      continue;
    }
    const SpatialInertia& inertia = link_inertia_[i];
    const Vector6& w = virtual_twist_[i];
    const Vector6& v = twist_[i];
    c.momentum = inertia * w;
    // z = V ×* I W − W ×* I V − I (V × W)
    c.z = CrossForce(v, c.momentum) - CrossForce(w, inertia * v) - inertia * CrossMotion(v, w);
    Matrix3 k = 2 * inertia.rotational;
    k.diagonal().array() -= inertia.rotational.trace();
    c.e.noalias() = k * Skew(w.head<3>()) + 2 * Skew(w.tail<3>()) * Skew(inertia.moment);
  }
  for (int i = n_ - 1; i > 0; --i) {
    const int p = parent_[i];
    if (p < 0) continue;
    virtual_[p].momentum += virtual_[i].momentum;
    virtual_[p].z += virtual_[i].z;
    virtual_[p].e += virtual_[i].e;
  }
}

void TreeDynamics::AddContractedHessian(const double* lambda, Eigen::Ref<MatrixX> h_qq, Eigen::Ref<MatrixX> h_qv,
                                        Eigen::Ref<MatrixX> h_qa, Eigen::Ref<MatrixX> h_vv) {
  UpdateVirtual(lambda);
  for (int k = 0; k < n_; ++k) {
    const Composite& c = composite_[k];
    const VirtualComposite& w = virtual_[k];
    const Vector6& s = axis_[k];
    const Vector6& psi = psi_[k];
    const auto e_transpose = [&w](const Vector6& x) {
      Vector6 y;
      y.head<3>() = w.e.transpose() * x.head<3>();
      y.tail<3>() = 2 * w.momentum.tail<3>().cross(x.head<3>());
      return y;
    };
    // Covectors of ∂L/∂q_k, ∂L/∂v_k, ∂L/∂a_k on the triple (Ω, Ψ, Ψ2); see the class comment.
    const Vector6 q_omega = CrossForce(s, c.force) + c.inertia * psi2_[k] + ApplyCoriolis(c, psi);
    const Vector6 q_psi = ApplyCoriolisTranspose(c, omega_[k]) + 2 * CrossForce(psi, w.momentum) + CrossForce(s, w.z) +
                          e_transpose(psi);
    const Vector6 q_psi2 = c.inertia * omega_[k] + CrossForce(s, w.momentum);
    const Vector6 v_omega = 2 * (c.inertia * psi) + ApplyCoriolis(c, s);
    const Vector6 v_psi = 2 * CrossForce(s, w.momentum) + e_transpose(s);
    const Vector6 a_omega = c.inertia * s;
    for (int m = k; m >= 0; m = parent_[m]) {
      const double qq = q_omega.dot(omega_[m]) + q_psi.dot(psi_[m]) + q_psi2.dot(psi2_[m]);
      const double vv = v_psi.dot(axis_[m]);
      h_qq(k, m) += qq;
      h_vv(k, m) += vv;
      h_qv(m, k) += v_omega.dot(omega_[m]) + v_psi.dot(psi_[m]);
      h_qa(m, k) += a_omega.dot(omega_[m]);
      if (m == k) continue;
      h_qq(m, k) += qq;
      h_vv(m, k) += vv;
      h_qv(k, m) += q_psi.dot(axis_[m]) + 2 * q_psi2.dot(psi_[m]);
      h_qa(k, m) += q_psi2.dot(axis_[m]);
    }
  }
}

}  // namespace rollgait
