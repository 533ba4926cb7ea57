#include "core/simulation/scene_dynamics.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/multibody/configuration.h"

namespace rollgait {
namespace {

// What rounding leaves of a slip's rate of change, over the terms that cancel in it and the accelerations that gravity
// and the contact forces would give to the whole mechanism.
constexpr double kSlipRateRounding = 1e-9;

std::vector<TreeContact> TreeContacts(const SimulationScene& scene) {
  std::vector<TreeContact> contacts;
  for (const SceneContact& contact : scene.contacts) contacts.push_back(contact.contact);
  return contacts;
}

std::vector<int> ActiveAtTheStart(const SimulationScene& scene) {
  std::vector<int> active;
  for (size_t k = 0; k < scene.contacts.size(); ++k) {
    if (scene.contacts[k].active) active.push_back(static_cast<int>(k));
  }
  return active;
}

}  // namespace

SceneDynamics::SceneDynamics(const SimulationScene& scene)
    : scene_(scene),
      nq_(scene.model.nq()),
      nv_(scene.model.nv()),
      contacts_(BodyDynamics(scene.model), TreeContacts(scene)),
      active_(ActiveAtTheStart(scene)),
      ground_(scene.ground.size()),
      tau_(VectorX::Zero(nv_)),
      solver_(scene.model.ColumnParents()) {
  for (int i = 0; i < scene.model.size(); ++i) {
    if (!scene.model.joint(i).kind().is_free()) tau_[scene.model.v_index(i)] = scene.efforts[i];
  }
}

VectorX SceneDynamics::MakeState(const VectorX& q, const VectorX& v, double work) const {
  VectorX x(size());
  x << q, v, work;
  return x;
}

bool SceneDynamics::IsActive(int k) const { return std::binary_search(active_.begin(), active_.end(), k); }

void SceneDynamics::SetState(double t, const VectorX& x) {
  q_ = x.head(nq_);
  v_ = x.segment(nq_, nv_);
  for (size_t i = 0; i < ground_.size(); ++i) ground_[i] = MotionAt(scene_.ground[i], t);
  contacts_.SetState(q_, v_, ground_);
}

Vector3 SceneDynamics::TangentialSlip(int k) {
  const PairKinematics& pair = contacts_.Kinematics(k);
  if (contacts_.contact(k).grip == Grip::kRollingAlong) {
    const Vector3 t = contacts_.Tangent(k);
    return t * t.dot(pair.slip);
  }
  return pair.slip - pair.normal * pair.normal.dot(pair.slip);
}

Vector3 SceneDynamics::TangentialForce(int k) {
  const Vector3 &force = contacts_.Force(k), &n = contacts_.Kinematics(k).normal;
  return force - n * n.dot(force);
}

void SceneDynamics::Slide(int k, const Vector3& direction) {
  contacts_.SetSliding(k, Sliding{scene_.contacts[static_cast<size_t>(k)].friction, direction});
}

double SceneDynamics::SlipRate(int k, const Vector3& direction) {
  contacts_.SlipJacobian(k, &linear_, &angular_);
  const Vector3 change = linear_ * solution_->acceleration, &drift = contacts_.Kinematics(k).drift;
  const double rate = direction.dot(change + drift);
  double force = 0;
  for (int i : active_) force += contacts_.Force(i).norm();
  const double of_all = scene_.gravity.norm() + force / contacts_.dynamics().total_mass();
  return std::abs(rate) <= kSlipRateRounding * (change.norm() + drift.norm() + of_all) ? 0 : rate;
}

bool SceneDynamics::IsAtRest(int k, double speed) {
  contacts_.VelocityRows({k}, &jacobian_, &right_);
  return right_.cwiseAbs().maxCoeff() <= speed;
}

// Without slip the normal's motion does not change the gap's rate.
double SceneDynamics::GapAcceleration(int k) { return SlipRate(k, contacts_.Kinematics(k).normal); }

bool SceneDynamics::TurnsBack(int k) {
  return TangentialSlip(k).norm() <= kSlidingBlend && SlipRate(k, contacts_.SlidingDirection(k)) < 0;
}

bool SceneDynamics::FollowSlip() {
  bool any = false;
  for (int k : active_) {
    if (!IsSliding(k)) continue;
    any = true;
    const Vector3 slip = TangentialSlip(k);
    // Below the blend the direction is carried on: at the very start there is none.
    if (slip.norm() > kSlidingBlend) Slide(k, slip.normalized());
  }
  return any;
}

double SceneDynamics::Power() const {
  double power = tau_.dot(v_);
  for (int i = 0; i < scene_.model.size(); ++i) {
    const Joint& joint = scene_.model.joint(i);
    const int damped = joint.kind().is_free() ? 3 : 1;
    power -= joint.damping * v_.segment(scene_.model.v_index(i), damped).squaredNorm();
  }
  return power;
}

void SceneDynamics::RightSide(double t, const VectorX& x, VectorX* derivative) {
  ++evaluations_;
  SetState(t, x);
  const Baumgarte none;
  const bool baumgarte = scene_.options.drift == DriftControl::kBaumgarte;
  solution_ = &contacts_.Accelerate(active_, tau_, scene_.gravity, baumgarte ? scene_.options.baumgarte : none);
  PositionRate(scene_.model, q_, v_, &rate_);
  derivative->head(nq_) = rate_;
  derivative->segment(nq_, nv_) = solution_->acceleration;
  double power = Power();
  for (int k : active_) {
    // Power of the contact on the mechanism: on body 1, less what body 2 gets back if it belongs to the mechanism.
    contacts_.SlipJacobian(k, &linear_, &angular_);
    power += contacts_.Force(k).dot(linear_ * v_);
    if (contacts_.SpinTorque(k) != 0) {
      power += contacts_.SpinTorque(k) * contacts_.Kinematics(k).normal.dot(angular_ * v_);
    }
  }
  (*derivative)[nq_ + nv_] = power;
}

double SceneDynamics::FirstStep(const VectorX& x, const VectorX& derivative) const {
  constexpr double kChange = 0.001;
  const double size = std::max(1.0, x.head(nq_).cwiseAbs().maxCoeff());
  const double rate = derivative.head(nq_).cwiseAbs().maxCoeff();
  const double speed = x.segment(nq_, nv_).cwiseAbs().maxCoeff();
  const double acceleration = derivative.segment(nq_, nv_).cwiseAbs().maxCoeff();
  const double of_position = rate > 0 ? kChange * size / rate : kInfinity;
  const double of_velocity = acceleration == 0 ? kInfinity
                             : speed > 0       ? kChange * speed / acceleration
                                               : std::sqrt(2 * kChange * size / acceleration);
  return std::min(of_position, of_velocity);
}

double SceneDynamics::KineticEnergy() const { return contacts_.dynamics().KineticEnergy(contacts_.state()); }

double SceneDynamics::PotentialEnergy() const {
  return contacts_.dynamics().PotentialEnergy(contacts_.state(), scene_.gravity);
}

SceneDynamics::Drift SceneDynamics::Project(double t, bool positions_and_velocities, VectorX* x) {
  Drift drift;
  VectorX q = x->head(nq_);
  drift.quaternion = NormalizeQuaternions(scene_.model, &q);
  x->head(nq_) = q;
  if (!positions_and_velocities || active_.empty()) return drift;

  const int m = static_cast<int>(active_.size());
  SetState(t, *x);
  jacobian_.resize(m, nv_);
  right_.resize(m);
  for (int i = 0; i < m; ++i) {
    const PairKinematics& pair = contacts_.Kinematics(active_[i]);
    contacts_.SlipJacobian(active_[i], &linear_, &angular_);
    jacobian_.row(i) = pair.normal.transpose() * linear_;
    right_[i] = -pair.gap;
    drift.gap = std::max(drift.gap, std::abs(pair.gap));
  }
  solver_.Solve(contacts_.MassMatrix(), VectorX::Zero(nv_), jacobian_, right_, &correction_);
  x->head(nq_) = Retract(scene_.model, q, correction_.acceleration);

  SetState(t, *x);
  contacts_.VelocityRows(active_, &jacobian_, &right_);
  drift.slip = right_.cwiseAbs().maxCoeff();
  solver_.Solve(contacts_.MassMatrix(), VectorX::Zero(nv_), jacobian_, -right_, &correction_);
  x->segment(nq_, nv_) += correction_.acceleration;
  return drift;
}

}  // namespace rollgait
