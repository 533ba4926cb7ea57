#ifndef ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_
#define ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/manoeuvre.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/findings.h"

namespace rollgait {

struct EndState {
  VectorX position;  // rad, m
  VectorX velocity;  // rad/s, m/s
};

// The state in which the trajectory must end to be periodic: its first node, mirrored (joint j takes mirror_sign times
// the value of mirror_joint) if it spans half a cycle, with the forward joint of the base, if there is one, moved on by
// the displacement.
EndState PeriodicEnd(const Model& model, const Trajectory& trajectory);

// Largest difference between the last node and PeriodicEnd over positions and velocities: rad, m, rad/s, m/s; over
// positions alone where velocities jump at the start (jumps.h). 0 for a motion that is not periodic (Cycle::kOnce).
double PeriodicityError(const Model& model, const Trajectory& trajectory, FindingLog* log);

// Largest difference between what the manoeuvre prescribes at its two ends and what the body that carries the first
// contact does at the first and the last node (its orientation is that of the surface): m, rad (angle of the rotation
// between the two), rad/s.
double EndError(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                const Manoeuvre& manoeuvre);

struct BalanceErrors {
  // J, |change of kinetic and potential energy between first and last node − work of the efforts + losses that the
  // trajectory states for jumps between its phases|
  double energy = 0;
  // energy / max(positive work, |negative work|). If the efforts do no work: relative to the largest kinetic energy at
  // the nodes (infinite if that is zero). 0 where `energy` is at most 1e-13 of the largest sum of kinetic and
  // (absolute) potential energy at the nodes, which rounding explains.
  double energy_relative = 0;
  // N s, |∫ (contact forces + weight) dt + impulses between phases − change of linear momentum|, all three world axes
  double momentum = 0;
};

// Integrals along the returned trajectory by Gauss quadrature, exact for its polynomials. The momentum balance supposes
// that the world acts on the tree through the contacts and gravity alone (no actuated joint has the world as its
// parent). The log gets the errors of the whole motion (relative; over the mass), at the start of the interval whose
// own error is largest, and every interval's own errors on the same scales.
BalanceErrors MeasureBalances(const BodyDynamics& dynamics, const Model& model, const Trajectory& trajectory,
                              const Vector3& gravity, FindingLog* log);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_RESIDUALS_H_
