#include "core/contact/contact_dynamics.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/base/check.h"

namespace rollgait {
namespace {

// A link with its bias accelerations as classical ones.
FrameMotion Classical(const BodyDynamics::Link& link) {
  FrameMotion motion;
  motion.R_WB = link.R_WL;
  motion.p_WB = link.p_WL;
  motion.w_WB = link.R_WL * link.twist.angular;
  motion.v_WB = link.R_WL * link.twist.linear;
  motion.alpha_WB = link.R_WL * link.bias.angular;
  motion.a_WB = link.R_WL * (link.bias.linear + link.twist.angular.cross(link.twist.linear));
  return motion;
}

}  // namespace

ContactDynamics::ContactDynamics(const BodyDynamics& dynamics, std::vector<TreeContact> contacts)
    : dynamics_(dynamics),
      contacts_(std::move(contacts)),
      sliding_(contacts_.size()),
      pairs_(contacts_.size()),
      kinematics_(contacts_.size()),
      motion_(dynamics.model()),
      mass_(MatrixX::Zero(dynamics.nv(), dynamics.nv())),
      no_acceleration_(VectorX::Zero(dynamics.nv())),
      solver_(dynamics.model().ColumnParents()),
      forces_(contacts_.size(), Vector3::Zero()),
      spin_torques_(contacts_.size(), 0.0) {
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const TreeContact& contact = contacts_[k];
    ROLLGAIT_CHECK(contact.link >= 0 && contact.link < dynamics_.size());
    ROLLGAIT_CHECK(contact.other_link < dynamics_.size() && contact.other_link != contact.link);
    const auto* other = std::get_if<PlacedSurface>(&contact.other);
    if (other != nullptr) pairs_[k].emplace(contact.surface, *other);
  }
}

void ContactDynamics::SetSliding(int k, const std::optional<Sliding>& sliding) {
  ROLLGAIT_CHECK(!sliding || (contacts_[k].grip != Grip::kFrictionless && !contacts_[k].no_spin));
  sliding_[k] = sliding;
}

Vector3 ContactDynamics::SlidingDirection(int k) {
  const Vector3& reference = sliding_[k]->reference;
  if (contacts_[k].grip == Grip::kRollingAlong) {
    const Vector3 t = Tangent(k);
    return t.dot(reference) < 0 ? Vector3(-t) : t;
  }
  const PairKinematics& pair = Kinematics(k);
  const Vector3& n = pair.normal;
  const Vector3 slip = pair.slip - n * n.dot(pair.slip);
  const Vector3 ahead = reference - n * n.dot(reference);
  return ((ahead.dot(slip) < 0 ? -1.0 : 1.0) * slip + kSlidingBlend * ahead).normalized();
}

double ContactDynamics::SlipAlongReference(int k) {
  const Vector3& slip = Kinematics(k).slip;
  if (contacts_[k].grip == Grip::kRolling) return sliding_[k]->reference.dot(slip);
  return SlidingDirection(k).dot(slip);
}

bool ContactDynamics::AnySlides(const std::vector<int>& active) const {
  for (int k : active) {
    if (sliding_[k]) return true;
  }
  return false;
}

void ContactDynamics::ForceRows(const std::vector<int>& active, const MatrixX& jacobian, MatrixX* force_jacobian) {
  *force_jacobian = jacobian;
  int row = 0;
  for (int k : active) {
    if (sliding_[k]) {
      SlipJacobian(k, &linear_, nullptr);
      force_jacobian->row(row) -= sliding_[k]->friction * (SlidingDirection(k).transpose() * linear_);
    }
    row += Rows(k);
  }
}

void ContactDynamics::SetState(const VectorX& q, const VectorX& v, const std::vector<FrameMotion>& ground) {
  dynamics_.ComputeState(q, v, &state_);
  velocity_ = v;
  ground_ = ground;
  links_.resize(state_.size());
  for (const TreeContact& contact : contacts_) {
    links_[contact.link] = Classical(state_[contact.link]);
    if (contact.other_link >= 0) links_[contact.other_link] = Classical(state_[contact.other_link]);
  }
  for (auto& kinematics : kinematics_) kinematics.reset();
  motion_known_ = mass_known_ = false;
}

const PairKinematics& ContactDynamics::Kinematics(int k) {
  if (!kinematics_[k]) {
    const TreeContact& contact = contacts_[k];
    const auto* plane = std::get_if<PlacedPlane>(&contact.other);
    kinematics_[k] = plane != nullptr ? ComputePlaneContact(contact.surface, Body1(k), *plane, Body2(k))
                                      : pairs_[k]->Compute(Body1(k), Body2(k));
  }
  return *kinematics_[k];
}

double ContactDynamics::Spin(int k) { return Kinematics(k).normal.dot(Body1(k).w_WB - Body2(k).w_WB); }

void ContactDynamics::SlipJacobian(int k, MatrixX* linear, MatrixX* angular) {
  const TreeContact& contact = contacts_[k];
  const PairKinematics& pair = Kinematics(k);
  twist_.setZero(6, dynamics_.nv());
  dynamics_.AddTwistJacobian(state_, contact.link, pair.p_1, 1, &twist_);
  if (contact.other_link >= 0) {
    // A plane's material point is the one at p_1, also when there is a gap.
    const bool plane = std::holds_alternative<PlacedPlane>(contact.other);
    dynamics_.AddTwistJacobian(state_, contact.other_link, plane ? pair.p_1 : pair.p_2, -1, &twist_);
  }
  *linear = twist_.bottomRows<3>();
  if (angular != nullptr) *angular = twist_.topRows<3>();
}

MotionDerivatives& ContactDynamics::Motion() {
  if (!motion_known_) motion_.SetState(state_);
  motion_known_ = true;
  return motion_;
}

const MatrixX& ContactDynamics::MassMatrix() {
  if (!mass_known_) Motion().MassMatrix(mass_);
  mass_known_ = true;
  return mass_;
}

Vector3 ContactDynamics::Tangent(int k) {
  const Vector3& n = Kinematics(k).normal;
  const Vector3 along = Body2(k).R_WB * contacts_[k].along;
  return (along - n * n.dot(along)).normalized();
}

int ContactDynamics::WriteRows(int k, int row, MatrixX* jacobian) {
  SlipJacobian(k, &linear_, contacts_[k].no_spin ? &angular_ : nullptr);
  const Vector3& n = Kinematics(k).normal;
  if (GripNow(k) == Grip::kRolling) {
    jacobian->middleRows(row, 3) = linear_;
    row += 3;
  } else {
    if (GripNow(k) == Grip::kRollingAlong) jacobian->row(row++).noalias() = Tangent(k).transpose() * linear_;
    jacobian->row(row++).noalias() = n.transpose() * linear_;
  }
  if (contacts_[k].no_spin) jacobian->row(row++).noalias() = n.transpose() * angular_;
  return row;
}

void ContactDynamics::AccelerationRows(const std::vector<int>& active, const Baumgarte& baumgarte, MatrixX* jacobian,
                                       VectorX* right) {
  int rows = 0;
  for (int k : active) rows += Rows(k);
  jacobian->resize(rows, dynamics_.nv());
  right->resize(rows);
  int row = 0;
  for (int k : active) {
    const PairKinematics& pair = Kinematics(k);
    const Vector3& n = pair.normal;
    const double along_normal = -pair.gap_acceleration - 2 * baumgarte.damping * baumgarte.frequency * pair.gap_rate -
                                baumgarte.frequency * baumgarte.frequency * pair.gap;
    const Vector3 wanted = -pair.drift - baumgarte.slip_rate * pair.slip;
    int next = row;
    if (GripNow(k) == Grip::kRolling) {
      right->segment<3>(next) = wanted + n * (along_normal - n.dot(wanted));
      next += 3;
    } else {
      if (GripNow(k) == Grip::kRollingAlong) {
        // The tangent turns with body 2: d(t·w)/dt = t·ẇ + ṫ·w, and ṫ·w = (ω₂ × t)·w to the order in which w is held at
        // 0.
        const Vector3 t = Tangent(k);
        (*right)[next++] = t.dot(wanted) - Body2(k).w_WB.cross(t).dot(pair.slip);
      }
      (*right)[next++] = along_normal;
    }
    if (contacts_[k].no_spin) {
      const Vector3 omega = Body1(k).w_WB - Body2(k).w_WB, alpha = Body1(k).alpha_WB - Body2(k).alpha_WB;
      (*right)[next++] = -n.dot(alpha) - pair.normal_dot.dot(omega) - baumgarte.slip_rate * n.dot(omega);
    }
    row = WriteRows(k, row, jacobian);
    ROLLGAIT_CHECK(row == next);
  }
}

void ContactDynamics::VelocityRows(const std::vector<int>& active, MatrixX* jacobian, VectorX* rate) {
  int rows = 0;
  for (int k : active) rows += Rows(k);
  jacobian->resize(rows, dynamics_.nv());
  rate->resize(rows);
  int row = 0;
  for (int k : active) {
    const PairKinematics& pair = Kinematics(k);
    int next = row;
    if (GripNow(k) == Grip::kRolling) {
      rate->segment<3>(next) = pair.slip;
      next += 3;
    } else {
      if (GripNow(k) == Grip::kRollingAlong) (*rate)[next++] = Tangent(k).dot(pair.slip);
      (*rate)[next++] = pair.gap_rate;
    }
    if (contacts_[k].no_spin) (*rate)[next++] = Spin(k);
    row = WriteRows(k, row, jacobian);
  }
}

const ConstrainedSolution& ContactDynamics::Accelerate(const std::vector<int>& active, const VectorX& tau,
                                                       const Vector3& gravity, const Baumgarte& baumgarte) {
  AccelerationRows(active, baumgarte, &jacobian_, &right_);
  Motion().SetAcceleration(no_acceleration_, gravity);
  motion_.InverseDynamics(&force_);
  force_ = tau - force_;
  if (AnySlides(active)) {
    ForceRows(active, jacobian_, &force_jacobian_);
    solver_.SolveSliding(MassMatrix(), force_, jacobian_, force_jacobian_, right_, &solution_);
  } else {
    solver_.Solve(MassMatrix(), force_, jacobian_, right_, &solution_);
  }
  Distribute(active, solution_.forces, &forces_, &spin_torques_);
  return solution_;
}

void ContactDynamics::Distribute(const std::vector<int>& active, const VectorX& rows, std::vector<Vector3>* forces,
                                 std::vector<double>* spin_torques) {
  forces->assign(contacts_.size(), Vector3::Zero());
  spin_torques->assign(contacts_.size(), 0.0);
  int row = 0;
  for (int k : active) {
    Vector3& force = (*forces)[k];
    if (GripNow(k) == Grip::kRolling) {
      force = rows.segment<3>(row);
      row += 3;
    } else {
      if (GripNow(k) == Grip::kRollingAlong) force += rows[row++] * Tangent(k);
      const Vector3& n = Kinematics(k).normal;
      const double normal = rows[row++];
      force += normal * (sliding_[k] ? Vector3(n - sliding_[k]->friction * SlidingDirection(k)) : n);
    }
    if (contacts_[k].no_spin) (*spin_torques)[k] = rows[row++];
  }
}

}  // namespace rollgait
