#ifndef ROLLGAIT_CORE_CONTACT_ROLLING_KINEMATICS_H_
#define ROLLGAIT_CORE_CONTACT_ROLLING_KINEMATICS_H_

#include "core/base/types.h"
#include "core/contact/contact_surface.h"
#include "core/multibody/body_dynamics.h"

namespace rollgait {

// One surface over the fixed plane z = 0 (normal +z). World axes. The body need not touch the plane: everything refers
// to its lowest point P. Three velocities are kept apart: that of the material point of the body at P (slip), that of
// the geometric point P (point_velocity), and their difference, the motion of P over the surface.
struct RollingContact {
  Vector3 p_WP;            // m, lowest point of the surface
  double gap = 0;          // m, height of P over the plane, negative below it
  Vector3 slip;            // m/s, w = v_E + ω × r: rolling means w = 0
  Vector3 point_velocity;  // m/s, ṗ = w + S (ω × n)
  // m/s², γ of ẇ = J v̇ + γ. Exact also when w ≠ 0 and when the gap is not zero. Source: eqs (3.4)–(3.7), with the last
  // term ω × S (ω × n) that distinguishes rolling from a fixed point.
  Vector3 drift;
};

// Evaluates one surface at a state. `state` comes from ComputeState of the model that carries the surface.
RollingContact ComputeRollingContact(const ContactSurface& surface, const BodyDynamics::State& state);

// The Jacobian of the material point: rows `first_row` … of `jacobian` (directions × n) become ∂w/∂v in the surface's
// directions. `point` is p_WP. Contract: the rows exist and the matrix has dynamics.size() columns.
void RollingJacobian(const BodyDynamics& dynamics, const ContactSurface& surface, const BodyDynamics::State& state,
                     const Vector3& point, int first_row, MatrixX* jacobian);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_ROLLING_KINEMATICS_H_
