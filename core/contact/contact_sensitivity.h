#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_

#include <vector>

#include "core/base/types.h"
#include "core/contact/contact_dynamics.h"
#include "core/multibody/model.h"

namespace rollgait {

// Derivatives of ContactDynamics::Accelerate. Columns: tangent directions of q (nv, see configuration.h), v (nv), tau (nv).
struct ContactSensitivity {
  MatrixX acceleration_q, acceleration_v, acceleration_tau;  // nv × nv
  MatrixX forces_q, forces_v, forces_tau;                    // rows of the active contacts × nv, N or N m
  // True if rows depend on each other: then the derivatives of the accelerations hold along motions that keep the rows
  // consistent, and those of the forces are of the ones of least norm.
  bool redundant = false;
};

// By the equation that the solution satisfies (contact-math 7):
//   [M Jᵀ; J 0] [da; −dλ] = −d( [ID(q, v, a) − τ − Jᵀλ ; J a − r] )  at fixed a, λ.
// The right side's derivatives along q and v are central differences of order 8 of inverse dynamics, Jacobian and drift, all
// smooth and free of any solve, which leaves 1e-11 of their size or so; those along τ are exact. Not for evaluations by the
// thousand: 16 · 2 nv kinematics and inverse dynamics. Leaves `dynamics` at (q, v). `ground` as in ContactDynamics::SetState.
ContactSensitivity ComputeSensitivity(const Model& model, const VectorX& q, const VectorX& v, const VectorX& tau,
                                      const Vector3& gravity, const std::vector<FrameMotion>& ground,
                                      const std::vector<int>& active, const Baumgarte& baumgarte,
                                      ContactDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_
