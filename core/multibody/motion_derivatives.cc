#include "core/multibody/motion_derivatives.h"

#include "core/base/check.h"

namespace rollgait {
namespace {

Vector6 Stack(const Vector3& angular, const Vector3& linear) {
  Vector6 both;
  both << angular, linear;
  return both;
}

// A motion vector at the point p in world axes, moved to the origin of p.
Vector6 FromPoint(const Vector3& p, const Vector3& angular, const Vector3& linear) {
  return Stack(angular, linear + p.cross(angular));
}

// About the origin of p, the link's origin.
SpatialInertia WorldInertia(const Joint& joint, const BodyDynamics::Link& link, const Vector3& p) {
  SpatialInertia inertia;
  const Vector3 com = p + link.R_WL * joint.center_of_mass;
  inertia.mass = joint.mass;
  inertia.moment = joint.mass * com;
  inertia.rotational.noalias() = link.R_WL * joint.inertia * link.R_WL.transpose();
  inertia.rotational.noalias() -= inertia.moment * com.transpose();
  inertia.rotational.diagonal().array() += inertia.moment.dot(com);
  return inertia;
}

bool HasSpring(const Joint& joint) { return joint.stiffness > 0 || joint.damping > 0; }

}  // namespace

MotionDerivatives::MotionDerivatives(const Model& model) : model_(model) {
  columns_.resize(static_cast<size_t>(model.nv()));
  bodies_.resize(static_cast<size_t>(model.size()));
  paths_.resize(bodies_.size());
  for (int i = 0; i < model.size(); ++i) {
    std::vector<int>& path = paths_[static_cast<size_t>(i)];
    if (model.parent(i) >= 0) path = paths_[static_cast<size_t>(model.parent(i))];
    for (int c = 0; c < VelocityCount(model.joint(i).type); ++c) {
      path.push_back(model.v_index(i) + c);
      joint_of_.push_back(i);
    }
  }
  // Of each tree the first link with mass: a chain of massless joints that carries a base may begin far away.
  std::vector<int> roots(bodies_.size()), anchors(bodies_.size(), -1);
  for (int i = 0; i < model.size(); ++i) {
    bodies_[static_cast<size_t>(i)].massive = model.joint(i).mass > 0;
    const int root = roots[static_cast<size_t>(i)] =
        model.parent(i) < 0 ? i : roots[static_cast<size_t>(model.parent(i))];
    int& anchor = anchors[static_cast<size_t>(root)];
    if (anchor < 0 && model.joint(i).mass > 0) anchor = i;
  }
  for (size_t i = 0; i < bodies_.size(); ++i) bodies_[i].anchor = anchors[static_cast<size_t>(roots[i])];
}

void MotionDerivatives::Update(const BodyDynamics::State& state, const VectorX& v, const VectorX& a,
                               const Vector3& gravity) {
  ROLLGAIT_CHECK(v.size() == model_.nv());
  SetState(state);
  SetAcceleration(a, gravity);
  UpdateDerivatives();
}

void MotionDerivatives::SetState(const BodyDynamics::State& state) {
  ROLLGAIT_CHECK(state.size() == bodies_.size());
  for (int i = 0; i < model_.size(); ++i) {
    const Joint& joint = model_.joint(i);
    const BodyDynamics::Link& link = state[static_cast<size_t>(i)];
    Body& body = bodies_[static_cast<size_t>(i)];
    body.reference = state[static_cast<size_t>(body.anchor)].p_WL;
    const Vector3 p = body.origin = link.p_WL - body.reference;
    body.twist = FromPoint(p, link.R_WL * link.twist.angular, link.R_WL * link.twist.linear);
    if (joint.parent < 0) {
      body.velocity_product.setZero();
    } else {
      body.velocity_product = CrossMotion(bodies_[static_cast<size_t>(joint.parent)].twist, body.twist);
    }
    const int first = model_.v_index(i);
    for (int c = 0; c < VelocityCount(joint.type); ++c) {
      const bool free = joint.kind().is_free();
      const Vector3 direction = free ? Vector3(link.R_WL.col(c % 3)) : Vector3(link.R_WL * joint.axis);
      const bool turns = free ? c < 3 : joint.kind().turns;
      const double advance = free ? (turns ? 0 : 1) : joint.Advance();
      Vector6& s = columns_[static_cast<size_t>(first + c)].s;
      s = turns ? FromPoint(p, direction, Vector3::Zero()) : Stack(Vector3::Zero(), advance * direction);
      if (turns && advance != 0) s.tail<3>() += advance * direction;
    }
    if (body.massive) {
      body.own = WorldInertia(joint, link, p);
      body.gyroscopic = CrossForce(body.twist, body.own * body.twist);
    }
    body.inertia = body.own;
    body.spring = joint.stiffness * (link.position - joint.rest_position) + joint.damping * link.velocity;
    body.couple = joint.damping * link.spin;
  }
  for (int i = model_.size() - 1; i > 0; --i) {
    if (model_.parent(i) < 0) continue;
    bodies_[static_cast<size_t>(model_.parent(i))].inertia += bodies_[static_cast<size_t>(i)].inertia;
  }
}

void MotionDerivatives::SetAcceleration(const VectorX& a, const Vector3& gravity) {
  ROLLGAIT_CHECK(a.size() == model_.nv());
  gravity_ = gravity;
  for (int i = 0; i < model_.size(); ++i) {
    const int parent = model_.parent(i);
    Body& body = bodies_[static_cast<size_t>(i)];
    // A_k = A_p + Σ S a + V_p × (V_k − V_p)
    body.acceleration = body.velocity_product;
    if (parent < 0) {
      body.acceleration.tail<3>() -= gravity;
    } else {
      body.acceleration += bodies_[static_cast<size_t>(parent)].acceleration;
    }
    const int first = model_.v_index(i);
    for (int c = first; c < first + VelocityCount(model_.joint(i).type); ++c) {
      body.acceleration += columns_[static_cast<size_t>(c)].s * a[c];
    }
    if (body.massive) {
      body.force = body.own * body.acceleration + body.gyroscopic;
    } else {
      body.force.setZero();
    }
  }
  for (int i = model_.size() - 1; i > 0; --i) {
    if (model_.parent(i) < 0) continue;
    bodies_[static_cast<size_t>(model_.parent(i))].force += bodies_[static_cast<size_t>(i)].force;
  }
}

void MotionDerivatives::UpdateDerivatives() {
  const Vector6 root = Stack(Vector3::Zero(), -gravity_);
  for (int i = 0; i < model_.size(); ++i) {
    const int parent = model_.parent(i), first = model_.v_index(i);
    Body& body = bodies_[static_cast<size_t>(i)];
    const Vector6 parent_twist = parent < 0 ? Vector6(Vector6::Zero()) : bodies_[static_cast<size_t>(parent)].twist;
    const Vector6& parent_acceleration = parent < 0 ? root : bodies_[static_cast<size_t>(parent)].acceleration;
    for (int c = first; c < first + VelocityCount(model_.joint(i).type); ++c) {
      Column& column = columns_[static_cast<size_t>(c)];
      column.psi = CrossMotion(parent_twist, column.s);
      column.psi2 = CrossMotion(parent_acceleration, column.s) + CrossMotion(parent_twist, column.psi);
      column.rate = column.psi + CrossMotion(body.twist, column.s);
    }
    if (body.massive) {
      body.motion.Set(body.own, body.twist);
    } else {
      body.motion = CompositeMotion();
    }
  }
  for (int i = model_.size() - 1; i > 0; --i) {
    if (model_.parent(i) < 0) continue;
    bodies_[static_cast<size_t>(model_.parent(i))].motion += bodies_[static_cast<size_t>(i)].motion;
  }
}

void MotionDerivatives::MassMatrix(Eigen::Ref<MatrixX> mass) const {
  ROLLGAIT_CHECK(mass.rows() == model_.nv() && mass.cols() == model_.nv());
  const Eigen::Index stride = mass.outerStride();
  for (int k = 0; k < model_.nv(); ++k) {
    const auto joint = static_cast<size_t>(joint_of_[static_cast<size_t>(k)]);
    const Vector6 u = bodies_[joint].inertia * columns_[static_cast<size_t>(k)].s;
    double* const column = mass.data() + k * stride;
    double* const row = mass.data() + k;
    for (int m : paths_[joint]) {
      if (m > k) break;
      column[m] = row[m * stride] = u.dot(columns_[static_cast<size_t>(m)].s);
    }
  }
}

void MotionDerivatives::InverseDynamics(VectorX* tau) const {
  tau->resize(model_.nv());
  for (int k = 0; k < model_.nv(); ++k) {
    const auto joint = static_cast<size_t>(joint_of_[static_cast<size_t>(k)]);
    (*tau)[k] = columns_[static_cast<size_t>(k)].s.dot(bodies_[joint].force);
  }
  for (int i = 0; i < model_.size(); ++i) {
    if (!HasSpring(model_.joint(i))) continue;
    const Body& body = bodies_[static_cast<size_t>(i)];
    if (model_.joint(i).kind().is_free())
      tau->segment<3>(model_.v_index(i)) += body.couple;
    else
      (*tau)[model_.v_index(i)] += body.spring;
  }
}

void MotionDerivatives::InverseDynamics(Eigen::Ref<RowMajorMatrix> dq, Eigen::Ref<RowMajorMatrix> dv) const {
  ROLLGAIT_CHECK(dq.rows() == model_.nv() && dq.cols() == model_.nv());
  ROLLGAIT_CHECK(dv.rows() == model_.nv() && dv.cols() == model_.nv());
  for (int i = 0; i < model_.size(); ++i) {
    const Body& body = bodies_[static_cast<size_t>(i)];
    const std::vector<int>& path = paths_[static_cast<size_t>(i)];
    const int first = model_.v_index(i), count = VelocityCount(model_.joint(i).type);
    const size_t before = path.size() - static_cast<size_t>(count);  // columns of proper ancestors
    for (int k = first; k < first + count; ++k) {
      const Column& column = columns_[static_cast<size_t>(k)];
      // Row k along what moves it: itself, its joint, the joints before. BᵀS has no linear part.
      const Vector6 u = body.inertia * column.s;
      const Vector3 b = body.motion.ApplyTranspose(column.s).head<3>();
      double* const dq_row = &dq(k, 0);
      double* const dv_row = &dv(k, 0);
      for (int m : path) {
        const Column& moving = columns_[static_cast<size_t>(m)];
        dq_row[m] = u.dot(moving.psi2) + b.dot(moving.psi.head<3>());
        dv_row[m] = u.dot(moving.rate) + b.dot(moving.s.head<3>());
      }
      // Column k in the rows before, which stand still.
      const Vector6 by_q =
          CrossForce(column.s, body.force) + body.inertia * column.psi2 + body.motion.Apply(column.psi);
      const Vector6 by_v = body.inertia * column.rate + body.motion.Apply(column.s);
      for (size_t j = 0; j < before; ++j) {
        const Vector6& s = columns_[static_cast<size_t>(path[j])].s;
        dq(path[j], k) = s.dot(by_q);
        dv(path[j], k) = s.dot(by_v);
      }
    }
    if (!HasSpring(model_.joint(i))) continue;
    dq(first, first) += model_.joint(i).stiffness;
    const int turns = model_.joint(i).kind().is_free() ? 3 : 1;
    for (int k = first; k < first + turns; ++k) dv(k, k) += model_.joint(i).damping;
  }
}

MotionDerivatives::PointMotion MotionDerivatives::Origin(int link) const {
  const Body& body = bodies_[static_cast<size_t>(link)];
  PointMotion motion;
  motion.w = body.twist.head<3>();
  motion.v = body.twist.tail<3>() + motion.w.cross(body.origin);
  motion.alpha = body.acceleration.head<3>();
  motion.a = body.acceleration.tail<3>() + gravity_ + motion.alpha.cross(body.origin) + motion.w.cross(motion.v);
  return motion;
}

MotionDerivatives::Change MotionDerivatives::AtOrigin(const Body& body, const Vector6& pose, const Vector6& twist,
                                                      const Vector6& acceleration) const {
  const Vector3& p = body.origin;
  const Vector3 w = body.twist.head<3>(), v = body.twist.tail<3>() + w.cross(p), alpha = body.acceleration.head<3>();
  Change change;
  change.turn = pose.head<3>();
  change.shift = pose.tail<3>() + change.turn.cross(p);
  PointMotion& motion = change.motion;
  motion.w = twist.head<3>();
  motion.v = twist.tail<3>() + motion.w.cross(p) + w.cross(change.shift);
  motion.alpha = acceleration.head<3>();
  motion.a = acceleration.tail<3>() + motion.alpha.cross(p) + alpha.cross(change.shift) + motion.w.cross(v) +
             w.cross(motion.v);
  return change;
}

MotionDerivatives::Change MotionDerivatives::AlongPosition(int link, int c) const {
  const Body& body = bodies_[static_cast<size_t>(link)];
  const Column& column = columns_[static_cast<size_t>(c)];
  return AtOrigin(body, column.s, CrossMotion(column.s, body.twist) + column.psi,
                  CrossMotion(column.s, body.acceleration) + column.psi2 - CrossMotion(body.twist, column.psi));
}

MotionDerivatives::Change MotionDerivatives::AlongVelocity(int link, int c) const {
  const Body& body = bodies_[static_cast<size_t>(link)];
  const Column& column = columns_[static_cast<size_t>(c)];
  return AtOrigin(body, Vector6::Zero(), column.s, column.rate - CrossMotion(body.twist, column.s));
}

}  // namespace rollgait
