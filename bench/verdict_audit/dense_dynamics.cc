#include "bench/verdict_audit/dense_dynamics.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "bench/verdict_audit/kinematics.h"

namespace rollgait::audit {
namespace {

// rad or m; the change of J along the motion is differenced over twice this: errors of 1e-10 and 1e-11 of it from
// truncation and rounding.
constexpr double kDifference = 1e-5;
// Rows whose eigenvalues are below this share of the largest depend on each other: rounding leaves 1e-16, two surfaces
// of one foot that are 1 mm apart 1e-5.
constexpr double kRankTolerance = 1e-10;

// Forces or impulses of least norm for accelerations or velocities of the contacts.
VectorX SolveMobility(const MatrixX& mobility, const VectorX& right_side) {
  Eigen::CompleteOrthogonalDecomposition<MatrixX> solver;
  solver.setThreshold(kRankTolerance);
  solver.compute(mobility);
  return solver.solve(right_side);
}

}  // namespace

DenseDynamics::DenseDynamics(const Scene& scene, std::vector<int> contacts, const Vector3& gravity)
    : scene_(scene), contacts_(std::move(contacts)), gravity_(gravity), tree_(scene.model) {}

VectorX DenseDynamics::RowVelocities(const VectorX& q, const VectorX& v) const {
  const std::vector<LinkPose> poses = Poses(scene_.model, q, v);
  std::vector<double> rows;
  for (const int c : contacts_) {
    const ContactSurface& contact = scene_.contacts[static_cast<size_t>(c)];
    const Vector3 velocity = FindLowestPoint(contact, poses).velocity;
    for (const int direction : contact.directions) rows.push_back(velocity[direction]);
  }
  return Eigen::Map<const VectorX>(rows.data(), static_cast<Eigen::Index>(rows.size()));
}

MatrixX DenseDynamics::Mass(const VectorX& q) {
  MatrixX mass = MatrixX::Zero(q.size(), q.size());
  tree_.MassMatrix(q.data(), mass);
  return mass;
}

MatrixX DenseDynamics::ContactJacobian(const VectorX& q, const VectorX& v, std::vector<Vector3>* points) const {
  const std::vector<LinkPose> poses = Poses(scene_.model, q, v);
  MatrixX jacobian(0, q.size());
  for (const int c : contacts_) {
    const ContactSurface& contact = scene_.contacts[static_cast<size_t>(c)];
    points->push_back(FindLowestPoint(contact, poses).point);
    const MatrixX point = PointJacobian(scene_.model, poses, contact.joint, points->back());
    for (const int direction : contact.directions) {
      jacobian.conservativeResize(jacobian.rows() + 1, Eigen::NoChange);
      jacobian.bottomRows(1) = point.row(direction);
    }
  }
  return jacobian;
}

DenseDynamics::Impact DenseDynamics::Stop(const VectorX& q, const VectorX& v) {
  Impact impact;
  const Eigen::LLT<MatrixX> factor(Mass(q));
  const MatrixX jacobian = ContactJacobian(q, v, &impact.points);
  const VectorX impulses = SolveMobility(jacobian * factor.solve(jacobian.transpose()), -jacobian * v);
  impact.velocity = v + factor.solve(jacobian.transpose() * impulses);
  return impact;
}

DenseDynamics::Answer DenseDynamics::Evaluate(const VectorX& q, const VectorX& v, const VectorX& efforts) {
  const Model& model = scene_.model;
  const int n = model.size();
  const VectorX at_rest = VectorX::Zero(n);
  const Eigen::LLT<MatrixX> factor(Mass(q));
  VectorX force(n);
  tree_.Update(q.data(), v.data(), at_rest.data(), gravity_);
  tree_.InverseDynamics(force.data());
  force = -force;
  for (size_t a = 0; a < model.actuated().size(); ++a)
    force[model.actuated()[a]] += efforts[static_cast<Eigen::Index>(a)];
  Answer answer;
  answer.acceleration = factor.solve(force);
  if (contacts_.empty()) return answer;

  const double step = kDifference / std::max(1.0, v.cwiseAbs().maxCoeff());
  const VectorX drift = (RowVelocities(q + step * v, v) - RowVelocities(q - step * v, v)) / (2 * step);
  const MatrixX jacobian = ContactJacobian(q, v, &answer.points);
  const VectorX rows =
      SolveMobility(jacobian * factor.solve(jacobian.transpose()), -drift - jacobian * answer.acceleration);
  answer.acceleration += factor.solve(jacobian.transpose() * rows);
  int row = 0;
  for (const int c : contacts_) {
    Vector3 contact_force = Vector3::Zero();
    for (const int direction : scene_.contacts[static_cast<size_t>(c)].directions)
      contact_force[direction] = rows[row++];
    answer.forces.push_back(contact_force);
  }
  return answer;
}

DenseDynamics::State DenseDynamics::Step(const State& state, const IntervalMotion& interval, double theta, double delta,
                                         const Answer& first) {
  const double h = delta * interval.length();
  const VectorX middle = interval.Efforts(theta + delta / 2);
  const VectorX v2 = state.v + h / 2 * first.acceleration;
  const VectorX a2 = Evaluate(state.q + h / 2 * state.v, v2, middle).acceleration;
  const VectorX v3 = state.v + h / 2 * a2;
  const VectorX a3 = Evaluate(state.q + h / 2 * v2, v3, middle).acceleration;
  const VectorX v4 = state.v + h * a3;
  const VectorX a4 = Evaluate(state.q + h * v3, v4, interval.Efforts(theta + delta)).acceleration;
  return {state.q + h / 6 * (state.v + 2 * v2 + 2 * v3 + v4),
          state.v + h / 6 * (first.acceleration + 2 * a2 + 2 * a3 + a4)};
}

}  // namespace rollgait::audit
