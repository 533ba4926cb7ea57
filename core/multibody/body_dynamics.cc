#include "core/multibody/body_dynamics.h"

#include <cmath>

#include <Eigen/Geometry>

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
  return {link.R_PL.transpose() * m.angular,
          link.R_PL.transpose() * (m.linear + m.angular.cross(link.p_PL))};
}

}  // namespace

BodyDynamics::BodyDynamics(const Model& model) : total_mass_(model.total_mass()) {
  for (const Joint& joint : model.joints()) {
    joints_.push_back({joint.parent, joint.type == JointType::kRevolute, joint.axis, joint.R_PJ, joint.p_PJ,
                       InertiaAboutOrigin(joint.mass, joint.center_of_mass, joint.inertia)});
  }
}

void BodyDynamics::ComputeState(const VectorX& q, const VectorX& v, State* state) const {
  ROLLGAIT_CHECK(q.size() == size() && v.size() == size());
  state->resize(joints_.size());
  for (int i = 0; i < size(); ++i) {
    const JointData& joint = joints_[i];
    Link& link = (*state)[i];
    if (joint.turns) {
      link.R_PL.noalias() = joint.R_PJ * AxisRotation(joint.axis, q[i]);
      link.p_PL = joint.p_PJ;
    } else {
      link.R_PL = joint.R_PJ;
      link.p_PL = joint.p_PJ + joint.R_PJ * (joint.axis * q[i]);
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
    const Vector3 rate = joint.axis * v[i];
    if (joint.turns) {
      link.bias.angular += link.twist.angular.cross(rate);
      link.bias.linear += link.twist.linear.cross(rate);
      link.twist.angular += rate;
    } else {
      link.bias.linear += link.twist.angular.cross(rate);
      link.twist.linear += rate;
    }
  }
}

void BodyDynamics::MassMatrix(const State& state, Workspace* workspace, MatrixX* mass) const {
  const int n = size();
  mass->setZero(n, n);
  workspace->composite.resize(n);
  for (int i = 0; i < n; ++i) workspace->composite[i] = joints_[i].inertia;
  for (int i = n - 1; i >= 0; --i) {
    const JointData& joint = joints_[i];
    const Inertia& composite = workspace->composite[i];
    Motion unit;
    (joint.turns ? unit.angular : unit.linear) = joint.axis;
    Force f = Momentum(composite, unit);
    (*mass)(i, i) = joint.axis.dot(joint.turns ? f.moment : f.force);
    for (int k = i; joints_[k].parent >= 0;) {
      f = ToParent(f, state[k]);
      k = joints_[k].parent;
      (*mass)(i, k) = (*mass)(k, i) = joints_[k].axis.dot(joints_[k].turns ? f.moment : f.force);
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
  tau->resize(n);
  workspace->acceleration.resize(n);
  workspace->force.resize(n);
  // Motion due to a alone: the velocity products are in Link::bias, and gravity is an upward acceleration of the world.
  for (int i = 0; i < n; ++i) {
    const JointData& joint = joints_[i];
    Motion& motion = workspace->acceleration[i];
    motion = joint.parent < 0 ? Motion{} : ToChild(workspace->acceleration[joint.parent], state[i]);
    if (a != nullptr) (joint.turns ? motion.angular : motion.linear) += joint.axis * (*a)[i];

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
    (*tau)[i] = joint.axis.dot(joint.turns ? f.moment : f.force);
    if (joint.parent < 0) continue;
    const Force moved = ToParent(f, state[i]);
    workspace->force[joint.parent].moment += moved.moment;
    workspace->force[joint.parent].force += moved.force;
  }
}

void BodyDynamics::InverseDynamics(const State& state, const VectorX& a, const Vector3& gravity, Workspace* workspace,
                                   VectorX* tau) const {
  ROLLGAIT_CHECK(a.size() == size());
  NewtonEuler(state, &a, gravity, workspace, tau);
}

void BodyDynamics::BiasForce(const State& state, const Vector3& gravity, Workspace* workspace, VectorX* bias) const {
  NewtonEuler(state, nullptr, gravity, workspace, bias);
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
