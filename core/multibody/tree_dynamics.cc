#include "core/multibody/tree_dynamics.h"

#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

const Vector6 kZero6 = Vector6::Zero();

// Rotation about a unit axis, written for itself: BodyDynamics, which judges what this computes, has its own.
Matrix3 Rodrigues(const Vector3& axis, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  Matrix3 r = (1 - c) * axis * axis.transpose();
  r.diagonal().array() += c;
  return r + s * Skew(axis);
}

}  // namespace

TreeDynamics::TreeDynamics(const Model& model) : model_(&model), n_(model.size()), factor_(model.ColumnParents()) {
  ROLLGAIT_CHECK(!model.HasFreeJoint());  // q and v of one length: the optimal control stack's trees
  for (const Joint& joint : model.joints()) {
    JointData data;
    data.parent = joint.parent;
    data.turns = joint.kind().turns;
    data.advance = joint.Advance();
    data.slides = data.advance != 0;
    data.massive = joint.mass > 0;
    data.axis_index = 0;
    data.axis_sign = joint.axis.cwiseAbs().maxCoeff(&data.axis_index);
    data.axis_sign = joint.axis(data.axis_index) < 0 ? -1 : 1;
    data.aligned =
        joint.R_PJ == Matrix3::Identity() && joint.axis == data.axis_sign * Vector3(Vector3::Unit(data.axis_index));
    data.p_PJ = joint.p_PJ;
    data.axis = joint.axis;
    data.center_of_mass = joint.center_of_mass;
    data.R_PJ = joint.R_PJ;
    data.inertia = joint.inertia;
    data.mass = joint.mass;
    joints_.push_back(data);
    if (joint.stiffness > 0 || joint.damping > 0) {
      springs_.push_back({static_cast<int>(joints_.size()) - 1, joint.stiffness, joint.rest_position, joint.damping});
    }
  }
  rotation_.assign(n_, Matrix3::Identity());
  origin_.assign(n_, Vector3::Zero());
  axis_.assign(n_, kZero6);
  twist_ = acceleration_ = psi_ = psi2_ = force_ = virtual_twist_ = omega_ = axis_;
  link_inertia_.assign(n_, SpatialInertia());
  composite_.assign(n_, Composite());
  virtual_.assign(n_, VirtualComposite());
  moves_.assign(n_, 0);
  touched_ = moves_;
  scratch_ = VectorX::Zero(n_);
  std::vector<char> parent(static_cast<size_t>(n_), 0);
  for (const JointData& joint : joints_) {
    if (joint.parent >= 0) parent[static_cast<size_t>(joint.parent)] = 1;
  }
  path_of_.assign(n_, 0);
  depth_.assign(n_, 0);
  for (int leaf = 0; leaf < n_; ++leaf) {
    if (parent[static_cast<size_t>(leaf)]) continue;
    Path& path = paths_.emplace_back();
    for (int i = leaf; i >= 0; i = joints_[i].parent) path.joints.insert(path.joints.begin(), i);
    const int length = static_cast<int>(path.joints.size());
    path.vectors = RowMajorMatrix::Zero(18, (length + 3) / 4 * 4);
    for (int i = 0; i < length; ++i) {
      path_of_[path.joints[i]] = static_cast<int>(paths_.size()) - 1;
      depth_[path.joints[i]] = i;
    }
  }
}

// Pose of link i and the axis of its joint, from the pose of its parent.
void TreeDynamics::UpdatePose(int i, double q) {
  const JointData& joint = joints_[i];
  const int p = joint.parent;
  Matrix3& R = rotation_[i];
  Vector3& origin = origin_[i];
  if (p < 0) {
    R = joint.R_PJ;
    origin = joint.p_PJ;
  } else {
    if (joint.aligned)
      R = rotation_[p];
    else
      R.noalias() = rotation_[p] * joint.R_PJ;
    origin.noalias() = rotation_[p] * joint.p_PJ;
    origin += origin_[p];
  }
  const int k = joint.axis_index;
  const Vector3 axis_W = joint.aligned ? Vector3(joint.axis_sign * R.col(k)) : Vector3(R * joint.axis);
  if (joint.slides) {
    Slide(i, q, axis_W);
    return;
  }
  axis_[i] << axis_W, origin.cross(axis_W);
  if (!joint.aligned) {
    R *= Rodrigues(joint.axis, q);
    return;
  }
  const int l = (k + 1) % 3, m = (k + 2) % 3;
  const double s = joint.axis_sign * std::sin(q), c = std::cos(q);
  const Vector3 before = R.col(l);
  R.col(l) = c * before + s * R.col(m);
  R.col(m) = c * R.col(m) - s * before;
}

// What a joint does that moves its link along the axis, about which it may turn it as well.
void TreeDynamics::Slide(int i, double q, const Vector3& axis_W) {
  const JointData& joint = joints_[i];
  origin_[i] += (joint.advance * q) * axis_W;
  axis_[i] << Vector3::Zero(), joint.advance * axis_W;
  if (!joint.turns) return;
  axis_[i].head<3>() = axis_W;
  axis_[i].tail<3>() += origin_[i].cross(axis_W);
  rotation_[i] *= Rodrigues(joint.axis, q);
}

void TreeDynamics::UpdateKinematics(const double* q, const double* v) {
  for (int i = 0; i < n_; ++i) {
    UpdatePose(i, q[i]);
    const int p = joints_[i].parent;
    if (p < 0) {
      psi_[i].setZero();
      twist_[i] = axis_[i] * v[i];
    } else {
      psi_[i] = CrossMotion(twist_[p], axis_[i]);
      twist_[i] = twist_[p] + axis_[i] * v[i];
    }
  }
  for (JointSpring& spring : springs_) {
    spring.force = -spring.stiffness * (q[spring.joint] - spring.rest) - spring.damping * v[spring.joint];
  }
  springs_act_ = true;
  has_forces_ = has_composites_ = false;
}

void TreeDynamics::Update(const double* q, const double* v, const double* a, const Vector3& gravity) {
  UpdateKinematics(q, v);
  UpdateAccelerations(v, a, gravity);
}

void TreeDynamics::UpdateImpact(const double* q, const double* change) {
  scratch_.setZero();
  UpdateKinematics(q, scratch_.data());
  UpdateAccelerations(scratch_.data(), change, Vector3::Zero());
  springs_act_ = false;
}

void TreeDynamics::UpdateAccelerations(const double* v, const double* a, const Vector3& gravity) {
  root_acceleration_ << Vector3::Zero(), -gravity;
  for (int i = 0; i < n_; ++i) {
    const int p = joints_[i].parent;
    acceleration_[i] = (p < 0 ? root_acceleration_ : acceleration_[p]) + axis_[i] * a[i] + psi_[i] * v[i];
  }
}

// Newton and Euler for each link about its centre of mass, then the sums over subtrees.
void TreeDynamics::UpdateForces() {
  if (has_forces_) return;
  for (int i = 0; i < n_; ++i) {
    const JointData& joint = joints_[i];
    if (!joint.massive) {
      force_[i].setZero();
      continue;
    }
    const Matrix3& R = rotation_[i];
    const Vector3 com = origin_[i] + R * joint.center_of_mass;
    const Vector3 w = twist_[i].head<3>(), alpha = acceleration_[i].head<3>();
    const Vector3 velocity = twist_[i].tail<3>() + w.cross(com);
    // Classical acceleration of the material point at the centre of mass: that of the spatial field, and ω × its
    // velocity.
    const Vector3 f = joint.mass * (acceleration_[i].tail<3>() + alpha.cross(com) + w.cross(velocity));
    const Vector3 w_L = R.transpose() * w;
    const Vector3 turned = joint.inertia * w_L;
    const Vector3 moment_L = joint.inertia * (R.transpose() * alpha) + w_L.cross(turned);
    force_[i] << R * moment_L + com.cross(f), f;
  }
  for (int i = n_ - 1; i > 0; --i) {
    if (joints_[i].parent >= 0) force_[joints_[i].parent] += force_[i];
  }
  has_forces_ = true;
}

// Inertia of each link about the world origin, and of each subtree.
void TreeDynamics::UpdateInertias() {
  for (int i = 0; i < n_; ++i) {
    const JointData& joint = joints_[i];
    SpatialInertia& inertia = link_inertia_[i];
    if (joint.massive) {
      const Matrix3& R = rotation_[i];
      const Vector3 com = origin_[i] + R * joint.center_of_mass;
      inertia.mass = joint.mass;
      inertia.moment = joint.mass * com;
      const Matrix3 turned = R * joint.inertia;
      inertia.rotational.noalias() = turned * R.transpose();
      inertia.rotational.noalias() -= inertia.moment * com.transpose();
      inertia.rotational.diagonal().array() += inertia.moment.dot(com);
    }
    composite_[i].inertia = inertia;
  }
  for (int i = n_ - 1; i > 0; --i) {
    if (joints_[i].parent >= 0) composite_[joints_[i].parent].inertia += composite_[i].inertia;
  }
}

void TreeDynamics::UpdateComposites() {
  if (has_composites_) return;
  UpdateForces();
  UpdateInertias();
  for (int i = 0; i < n_; ++i) {
    const int p = joints_[i].parent;
    psi2_[i] = CrossMotion(p < 0 ? root_acceleration_ : acceleration_[p], axis_[i]);
    if (p >= 0) psi2_[i] += CrossMotion(twist_[p], psi_[i]);
    Composite& c = composite_[i];
    if (!joints_[i].massive) {
      c.motion = CompositeMotion();
      continue;
    }
    c.motion.Set(link_inertia_[i], twist_[i]);
  }
  for (int i = n_ - 1; i > 0; --i) {
    if (joints_[i].parent >= 0) composite_[joints_[i].parent].motion += composite_[i].motion;
  }
  has_composites_ = true;
}

void TreeDynamics::InverseDynamics(double* tau) {
  UpdateForces();
  for (int i = 0; i < n_; ++i) tau[i] = axis_[i].dot(force_[i]);
  if (!springs_act_) return;
  for (const JointSpring& spring : springs_) tau[spring.joint] -= spring.force;
}

void TreeDynamics::FirstDerivatives(Eigen::Ref<MatrixX> dq, Eigen::Ref<MatrixX> dv, Eigen::Ref<MatrixX> da) {
  UpdateComposites();
  for (int k = 0; k < n_; ++k) {
    const Composite& c = composite_[k];
    const Vector6& s = axis_[k];
    const Vector6 u = c.inertia * s;
    const Vector6 b = c.motion.ApplyTranspose(s);
    const Vector6 column_v = 2 * (c.inertia * psi_[k]) + c.motion.Apply(s);
    const Vector6 column_q = CrossForce(s, force_[k]) + c.inertia * psi2_[k] + c.motion.Apply(psi_[k]);
    // Row k against its ancestors and itself; column k against its proper ancestors.
    for (int m = k; m >= 0; m = joints_[m].parent) {
      dq(k, m) = u.dot(psi2_[m]) + b.dot(psi_[m]);
      dv(k, m) = 2 * u.dot(psi_[m]) + b.dot(axis_[m]);
      da(k, m) = u.dot(axis_[m]);
      if (m == k) continue;
      dq(m, k) = axis_[m].dot(column_q);
      dv(m, k) = axis_[m].dot(column_v);
      da(m, k) = da(k, m);
    }
  }
  if (!springs_act_) return;
  for (const JointSpring& spring : springs_) {
    dq(spring.joint, spring.joint) += spring.stiffness;
    dv(spring.joint, spring.joint) += spring.damping;
  }
}

void TreeDynamics::UpdateVirtual(const double* lambda) {
  for (int i = 0; i < n_; ++i) {
    const int p = joints_[i].parent;
    VirtualComposite& c = virtual_[i];
    moves_[i] = lambda[i] != 0 || (p >= 0 && moves_[p]);
    touched_[i] = moves_[i];
    if (!moves_[i] || !joints_[i].massive) c = VirtualComposite();
    if (p < 0 || !moves_[p]) {
      omega_[i].setZero();
      virtual_twist_[i] = axis_[i] * lambda[i];
    } else {
      omega_[i] = CrossMotion(virtual_twist_[p], axis_[i]);
      virtual_twist_[i] = virtual_twist_[p] + axis_[i] * lambda[i];
    }
    if (!moves_[i] || !joints_[i].massive) continue;
    const SpatialInertia& inertia = link_inertia_[i];
    const Vector6& w = virtual_twist_[i];
    const Vector6& v = twist_[i];
    c.momentum = inertia * w;
    // z = V ×* I W − W ×* I V − I (V × W)
    c.z = (CrossForce(v, c.momentum) - CrossForce(w, inertia * v) - inertia * CrossMotion(v, w)).head<3>();
    Matrix3 k = 2 * inertia.rotational;
    k.diagonal().array() -= inertia.rotational.trace();
    c.e.noalias() = k * Skew(w.head<3>()) + 2 * Skew(w.tail<3>()) * Skew(inertia.moment);
  }
  for (int i = n_ - 1; i > 0; --i) {
    const int p = joints_[i].parent;
    if (p < 0 || !touched_[i]) continue;
    touched_[p] = 1;
    virtual_[p].momentum += virtual_[i].momentum;
    virtual_[p].z += virtual_[i].z;
    virtual_[p].e += virtual_[i].e;
  }
}

void TreeDynamics::AddContractedHessian(const double* lambda, Eigen::Ref<MatrixX> h_qq, Eigen::Ref<MatrixX> h_qv,
                                        Eigen::Ref<MatrixX> h_qa, Eigen::Ref<MatrixX> h_vv) {
  UpdateComposites();
  UpdateVirtual(lambda);
  for (int k = 0; k < n_; ++k) {
    if (!touched_[k]) continue;
    const Composite& c = composite_[k];
    const VirtualComposite& w = virtual_[k];
    const Vector6& s = axis_[k];
    const Vector6& psi = psi_[k];
    // 2 x ×* P + Eᵀ x, which is a moment alone.
    const auto moment = [&w](const Vector6& x) {
      return Vector3(w.e.transpose() * x.head<3>() +
                     2 * (x.head<3>().cross(w.momentum.head<3>()) + x.tail<3>().cross(w.momentum.tail<3>())));
    };
    // Covectors of ∂L/∂q_k, ∂L/∂v_k, ∂L/∂a_k on the triple (Ω, Ψ, Ψ2); see the class comment.
    const Vector6 q_omega = CrossForce(s, force_[k]) + c.inertia * psi2_[k] + c.motion.Apply(psi);
    const Vector3 q_psi = c.motion.ApplyTranspose(omega_[k]).head<3>() + s.head<3>().cross(w.z) + moment(psi);
    const Vector6 q_psi2 = c.inertia * omega_[k] + CrossForce(s, w.momentum);
    const Vector6 v_omega = 2 * (c.inertia * psi) + c.motion.Apply(s);
    const Vector3 v_psi = moment(s);
    const Vector6 a_omega = c.inertia * s;
    for (int m = k; m >= 0; m = joints_[m].parent) {
      const double qq = q_omega.dot(omega_[m]) + q_psi.dot(psi_[m].head<3>()) + q_psi2.dot(psi2_[m]);
      const double vv = v_psi.dot(axis_[m].head<3>());
      h_qq(k, m) += qq;
      h_vv(k, m) += vv;
      h_qv(m, k) += v_omega.dot(omega_[m]) + v_psi.dot(psi_[m].head<3>());
      h_qa(m, k) += a_omega.dot(omega_[m]);
      if (m == k) continue;
      h_qq(m, k) += qq;
      h_vv(m, k) += vv;
      h_qv(k, m) += q_psi.dot(axis_[m].head<3>()) + 2 * q_psi2.dot(psi_[m]);
      h_qa(k, m) += q_psi2.dot(axis_[m]);
    }
  }
}

}  // namespace rollgait
