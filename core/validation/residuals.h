#ifndef ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_
#define ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_

#include "core/models/scene.h"
#include "core/trajectory/manoeuvre.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"

namespace rollgait {

// Raises *worst to value. A NaN counts as infinite, so that it cannot hide.
void RaiseTo(double value, double* worst);

// Extremes of contact forces. The friction ratio is |tangential| / max(normal, 0.001 × weight): below that floor a normal
// force says nothing about friction, and a pulling contact with a tangential force shows as a large ratio.
class ForceExtremes {
 public:
  // `weight` in N, > 0.
  explicit ForceExtremes(double weight) : weight_(weight) {}
  // A force of the ground on the body, N, world axes. A NaN counts as −∞ and as an infinite ratio.
  void Add(const Vector3& force);
  // N; 0 if no force was added.
  double min_normal() const { return any_ ? min_normal_ : 0; }
  double max_friction_ratio() const { return max_friction_ratio_; }

 private:
  double weight_;
  double min_normal_ = kInfinity;
  double max_friction_ratio_ = 0;
  bool any_ = false;
};

// What the returned trajectory does at its contacts, between the nodes too.
struct ContactResiduals {
  double max_gap = 0;              // m, |gap| of active contacts
  double max_slip = 0;             // m/s, |w| of active contacts in their directions
  double min_swing_clearance = 0;  // m, least gap of inactive contacts; 0 if every contact is always active
};

// Samples every interval at k/n, k = 0 … n, and at the scheme's points, and adds the forces at the points to `forces`.
// Contract: samples_per_interval >= 1.
ContactResiduals MeasureContacts(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                                 int samples_per_interval, ForceExtremes* forces);

struct EndState {
  VectorX position;  // rad, m
  VectorX velocity;  // rad/s, m/s
};

// The state in which the trajectory must end to be periodic: its first node, mirrored (joint j takes mirror_sign times the
// value of mirror_joint) if it spans half a cycle, with the joint "base_x", if there is one, moved on by the displacement.
EndState PeriodicEnd(const Model& model, const Trajectory& trajectory);

// Largest difference between the last node and PeriodicEnd over positions and velocities: rad, m, rad/s, m/s; over positions alone
// where velocities jump at the start (jumps.h). 0 for a motion that is not periodic (Cycle::kOnce).
double PeriodicityError(const Model& model, const Trajectory& trajectory);

// Largest difference between what the manoeuvre prescribes at its two ends and what the body that carries the first contact
// does at the first and the last node (its orientation is that of the surface): m, rad (angle of the rotation between the
// two), rad/s.
double EndError(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                const Manoeuvre& manoeuvre);

struct BalanceErrors {
  // J, |change of kinetic and potential energy between first and last node − work of the efforts + losses that the trajectory
  // states for jumps between its phases|
  double energy = 0;
  // energy / max(positive work, |negative work|). If the efforts do no work: relative to the largest kinetic energy at
  // the nodes (0 if that is zero and the error is too, else infinite).
  double energy_relative = 0;
  // N s, |∫ (contact forces + weight) dt + impulses between phases − change of linear momentum|, all three world axes
  double momentum = 0;
};

// Integrals along the returned trajectory by Gauss quadrature, exact for its polynomials. The momentum balance supposes
// that the world acts on the tree through the contacts and gravity alone (no actuated joint has the world as its parent).
BalanceErrors MeasureBalances(const BodyDynamics& dynamics, const Model& model, const Trajectory& trajectory,
                              const Vector3& gravity);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_
