#include "core/multibody/body_dynamics.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Force = BodyDynamics::Force;
using Inertia = BodyDynamics::Inertia;
using Motion = BodyDynamics::Motion;

// Rotation by an angle about a unit axis (Rodrigues).
Matrix3 AxisRotation(const Vector3& u, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  Matrix3 r;
  r << c + d * u.x() * u.x(), d * u.x() * u.y() - s * u.z(), d * u.x() * u.z() + s * u.y(),  //
      d * u.x() * u.y() + s * u.z(), c + d * u.y() * u.y(), d * u.y() * u.z() - s * u.x(),   //
      d * u.x() * u.z() - s * u.y(), d * u.y() * u.z() + s * u.x(), c + d * u.z() * u.z();
  return r;
}

// Rotation of the quaternion w, x, y, z after normalisation.
Matrix3 QuaternionRotation(const double* q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

// Inertia about a point at which the centre of mass has the position c, from the one about the centre of mass.
Inertia InertiaAboutOrigin(double mass, const Vector3& c, const Matrix3& about_center) {
  return {mass, mass * c, about_center + mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose())};
}

Force Momentum(const Inertia& inertia, const Motion& m) {
  return {inertia.rotational * m.angular + inertia.first_moment.cross(m.linear),
          inertia.mass * m.linear - inertia.first_moment.cross(m.angular)};
}

// The inertia of a link, turned into its parent's axes and moved to the parent's origin.
Inertia ToParent(const Inertia& inertia, const BodyDynamics::Link& link) {
  const Vector3 h = link.R_PL * inertia.first_moment;
  const Vector3& p = link.p_PL;
  Inertia result;
  result.mass = inertia.mass;
  result.first_moment = h + inertia.mass * p;
  result.rotational = link.R_PL * inertia.rotational * link.R_PL.transpose();
  result.rotational += (2 * p.dot(h) + inertia.mass * p.squaredNorm()) * Matrix3::Identity() - p * h.transpose() -
                       h * p.transpose() - inertia.mass * (p * p.transpose());
  return result;
}

Force ToParent(const Force& f, const BodyDynamics::Link& link) {
  Force result;
  result.force = link.R_PL * f.force;
  result.moment = link.R_PL * f.moment + link.p_PL.cross(result.force);
  return result;
}

// A motion of the parent link, seen at the link's origin in link axes.
Motion ToChild(const Motion& m, const BodyDynamics::Link& link) {
  return {link.R_PL.transpose() * m.angular, link.R_PL.transpose() * (m.linear + m.angular.cross(link.p_PL))};
}

}  // namespace

BodyDynamics::BodyDynamics(const Model& model)
    : model_(model), nq_(model.nq()), nv_(model.nv()), total_mass_(model.total_mass()) {
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    joints_.push_back({joint.parent, joint.kind().turns, joint.Advance() != 0, joint.Advance(), model.q_index(i),
                       model.v_index(i), VelocityCount(joint.type), joint.axis, joint.R_PJ, joint.p_PJ,
                       InertiaAboutOrigin(joint.mass, joint.center_of_mass, joint.inertia), joint.stiffness,
                       joint.rest_position, joint.damping});
  }
}

Motion BodyDynamics::Column(const JointData& joint, int c) {
  Motion unit;
  if (joint.free()) {
    (c < 3 ? unit.angular : unit.linear)[c % 3] = 1;
    return unit;
  }
  if (joint.turns) unit.angular = joint.axis;
  if (joint.slides) unit.linear = joint.advance * joint.axis;
  return unit;
}

double BodyDynamics::Along(const JointData& joint, int c, const Force& f) {
  if (joint.free()) return (c < 3 ? f.moment : f.force)[c % 3];
  if (!joint.turns) return joint.advance * joint.axis.dot(f.force);
  const double moment = joint.axis.dot(f.moment);
  return !joint.slides ? moment : moment + joint.advance * joint.axis.dot(f.force);
}

Motion BodyDynamics::Relative(const JointData& joint, const VectorX& v) {
  if (joint.free()) return {v.segment<3>(joint.v_index), v.segment<3>(joint.v_index + 3)};
  if (!joint.slides) return {joint.axis * v[joint.v_index], Vector3::Zero()};
  const Vector3 linear = joint.axis * (joint.advance * v[joint.v_index]);
  if (!joint.turns) return {Vector3::Zero(), linear};
  return {joint.axis * v[joint.v_index], linear};
}

void BodyDynamics::ComputeState(const VectorX& q, const VectorX& v, State* state) const {
  ROLLGAIT_CHECK(q.size() == nq_ && v.size() == nv_);
  state->resize(joints_.size());
  for (int i = 0; i < size(); ++i) {
    const JointData& joint = joints_[i];
    const double* position = q.data() + joint.q_index;
    Link& link = (*state)[i];
    if (joint.free()) {
      link.R_PL.noalias() = joint.R_PJ * QuaternionRotation(position);
      link.p_PL = joint.p_PJ + joint.R_PJ * q.segment<3>(joint.q_index + 4);
    } else {
      link.position = *position;
      link.velocity = v[joint.v_index];
      if (joint.turns) {
        link.R_PL.noalias() = joint.R_PJ * AxisRotation(joint.axis, *position);
      } else {
        link.R_PL = joint.R_PJ;
      }
      link.p_PL = joint.p_PJ;
      if (joint.slides) link.p_PL += joint.R_PJ * (joint.axis * (joint.advance * *position));
    }
    if (joint.parent < 0) {
      link.R_WL = link.R_PL;
      link.p_WL = link.p_PL;
      link.twist = Motion{};
      link.bias = Motion{};
    } else {
      const Link& parent = (*state)[joint.parent];
      link.R_WL.noalias() = parent.R_WL * link.R_PL;
      link.p_WL = parent.p_WL + parent.R_WL * link.p_PL;
      link.twist = ToChild(parent.twist, link);
      link.bias = ToChild(parent.bias, link);
    }
    // Joint velocity, and the velocity product V × (S v) with the V before it is added (S v × S v = 0).
    const Motion rate = Relative(joint, v);
    if (joint.free()) link.spin = rate.angular;
    link.bias.angular += link.twist.angular.cross(rate.angular);
    link.bias.linear += link.twist.angular.cross(rate.linear) + link.twist.linear.cross(rate.angular);
    link.twist.angular += rate.angular;
    link.twist.linear += rate.linear;
  }
}

void BodyDynamics::MassMatrix(const State& state, Workspace* workspace, MatrixX* mass) const {
  mass->setZero(nv_, nv_);
  workspace->composite.resize(joints_.size());
  for (int i = 0; i < size(); ++i) workspace->composite[i] = joints_[i].inertia;
  for (int i = size() - 1; i >= 0; --i) {
    const JointData& joint = joints_[i];
    const Inertia& composite = workspace->composite[i];
    for (int c = 0; c < joint.columns; ++c) {
      const int row = joint.v_index + c;
      Force f = Momentum(composite, Column(joint, c));
      for (int d = 0; d <= c; ++d) {
        (*mass)(row, joint.v_index + d) = (*mass)(joint.v_index + d, row) = Along(joint, d, f);
      }
      for (int k = i; joints_[k].parent >= 0;) {
        f = ToParent(f, state[k]);
        k = joints_[k].parent;
        for (int d = 0; d < joints_[k].columns; ++d) {
          const int column = joints_[k].v_index + d;
          (*mass)(row, column) = (*mass)(column, row) = Along(joints_[k], d, f);
        }
      }
    }
    if (joint.parent >= 0) {
      const Inertia moved = ToParent(composite, state[i]);
      Inertia& parent = workspace->composite[joint.parent];
      parent.mass += moved.mass;
      parent.first_moment += moved.first_moment;
      parent.rotational += moved.rotational;
    }
  }
}

void BodyDynamics::NewtonEuler(const State& state, const VectorX* a, const Vector3& gravity, Workspace* workspace,
                               VectorX* tau) const {
  const int n = size();
  tau->resize(nv_);
  workspace->acceleration.resize(n);
  workspace->force.resize(n);
  // Motion due to a alone: the velocity products are in Link::bias, and gravity is an upward acceleration of the world.
  for (int i = 0; i < n; ++i) {
    const JointData& joint = joints_[i];
    Motion& motion = workspace->acceleration[i];
    motion = joint.parent < 0 ? Motion{} : ToChild(workspace->acceleration[joint.parent], state[i]);
    if (a != nullptr) {
      const Motion relative = Relative(joint, *a);
      motion.angular += relative.angular;
      motion.linear += relative.linear;
    }

    Motion total;
    total.angular = motion.angular + state[i].bias.angular;
    total.linear = motion.linear + state[i].bias.linear - state[i].R_WL.transpose() * gravity;
    const Motion& twist = state[i].twist;
    const Force inertial = Momentum(joint.inertia, total);
    const Force momentum = Momentum(joint.inertia, twist);
    Force& f = workspace->force[i];
    f.moment = inertial.moment + twist.angular.cross(momentum.moment) + twist.linear.cross(momentum.force);
    f.force = inertial.force + twist.angular.cross(momentum.force);
  }
  for (int i = n - 1; i >= 0; --i) {
    const JointData& joint = joints_[i];
    const Force& f = workspace->force[i];
    for (int c = 0; c < joint.columns; ++c) (*tau)[joint.v_index + c] = Along(joint, c, f);
    if (joint.free()) {
      tau->segment<3>(joint.v_index) += joint.damping * state[i].spin;
    } else if (joint.stiffness > 0 || joint.damping > 0) {
      (*tau)[joint.v_index] += joint.stiffness * (state[i].position - joint.rest) + joint.damping * state[i].velocity;
    }
    if (joint.parent < 0) continue;
    const Force moved = ToParent(f, state[i]);
    workspace->force[joint.parent].moment += moved.moment;
    workspace->force[joint.parent].force += moved.force;
  }
}

void BodyDynamics::InverseDynamics(const State& state, const VectorX& a, const Vector3& gravity, Workspace* workspace,
                                   VectorX* tau) const {
  ROLLGAIT_CHECK(a.size() == nv_);
  NewtonEuler(state, &a, gravity, workspace, tau);
}

void BodyDynamics::BiasForce(const State& state, const Vector3& gravity, Workspace* workspace, VectorX* bias) const {
  NewtonEuler(state, nullptr, gravity, workspace, bias);
}

void BodyDynamics::AddTwistJacobian(const State& state, int link, const Vector3& point, double sign,
                                    MatrixX* jacobian) const {
  ROLLGAIT_CHECK(jacobian->rows() == 6 && jacobian->cols() == nv_);
  for (int j = link; j >= 0; j = joints_[j].parent) {
    const JointData& joint = joints_[j];
    if (joint.columns == 1) {
      const Vector3 axis = sign * (state[j].R_WL * joint.axis);
      auto column = jacobian->col(joint.v_index);
      if (joint.slides) column.tail<3>() += joint.advance * axis;
      if (!joint.turns) continue;
      column.head<3>() += axis;
      column.tail<3>() += axis.cross(point - state[j].p_WL);
      continue;
    }
    for (int c = 0; c < joint.columns; ++c) {
      const Motion column = Column(joint, c);
      const Vector3 angular = state[j].R_WL * column.angular;
      const Vector3 linear = state[j].R_WL * column.linear + angular.cross(point - state[j].p_WL);
      jacobian->col(joint.v_index + c).head<3>() += sign * angular;
      jacobian->col(joint.v_index + c).tail<3>() += sign * linear;
    }
  }
}

double BodyDynamics::KineticEnergy(const State& state) const {
  double energy = 0;
  for (int i = 0; i < size(); ++i) {
    const Force momentum = Momentum(joints_[i].inertia, state[i].twist);
    energy += 0.5 * (momentum.moment.dot(state[i].twist.angular) + momentum.force.dot(state[i].twist.linear));
  }
  return energy;
}

double BodyDynamics::PotentialEnergy(const State& state, const Vector3& gravity) const {
  double energy = 0;
  for (int i = 0; i < size(); ++i) {
    const Inertia& inertia = joints_[i].inertia;
    energy -= gravity.dot(inertia.mass * state[i].p_WL + state[i].R_WL * inertia.first_moment);
    const double stretch = state[i].position - joints_[i].rest;
    if (joints_[i].stiffness > 0) energy += 0.5 * joints_[i].stiffness * stretch * stretch;
  }
  return energy;
}

Vector3 BodyDynamics::LinearMomentum(const State& state) const {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < size(); ++i) sum += state[i].R_WL * Momentum(joints_[i].inertia, state[i].twist).force;
  return sum;
}

Vector3 BodyDynamics::CenterOfMass(const State& state) const {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < size(); ++i) {
    sum += joints_[i].inertia.mass * state[i].p_WL + state[i].R_WL * joints_[i].inertia.first_moment;
  }
  return sum / total_mass_;
}

}  // namespace rollgait
