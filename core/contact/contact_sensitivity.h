#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_

#include <vector>

#include "core/base/types.h"
#include "core/contact/contact_dynamics.h"
#include "core/contact/row_derivatives.h"
#include "core/multibody/motion_derivatives.h"

namespace rollgait {

// Derivatives of ContactDynamics::Accelerate. Columns: tangent directions of q (nv, see configuration.h), v (nv), tau
// (nv).
struct ContactSensitivity {
  RowMajorMatrix acceleration_q, acceleration_v, acceleration_tau;  // nv × nv
  RowMajorMatrix forces_q, forces_v, forces_tau;                    // rows of the active contacts × nv, N or N m
  // True if rows depend on each other: then the derivatives of the accelerations hold along motions that keep the rows
  // consistent, and those of the forces are of the ones of least norm.
  bool redundant = false;
  // False if a surface has no curvature, or no derivative of it, at an active contact; then the entries are not finite.
  bool exists = true;
};

// The equation that the solution satisfies (contact-math 7), linearised exactly, nothing by differences:
//   [M −Jᵀ; J 0] [da; dλ] = −d( [ID(q, v, a) − τ − Jᵀλ ; J a − r] )  at fixed a, λ.
// ID from MotionDerivatives; a contact's rows and forces from the derivatives of its pair by poses, twists and
// accelerations of the two bodies (RowDerivatives), chained with the motion of the links. No allocation after the first
// call with as many rows. One object a thread.
class ContactSensitivitySolver {
 public:
  // `dynamics`, of the same model, must outlive the solver.
  ContactSensitivitySolver(const Model& model, ContactDynamics* dynamics);

  // At the state that ContactDynamics::SetState was given last, with no contact that slides; the arguments are those of
  // Accelerate, which this calls. Valid until the next call.
  const ContactSensitivity& Solve(const std::vector<int>& active, const VectorX& tau, const Vector3& gravity,
                                  const Baumgarte& baumgarte);

 private:
  FrameMotion Frame(int link, int ground) const;
  // Adds the contact's share of the residual's derivatives; its rows begin at `row`.
  void AddContact(const TreeContact& contact, const RowDerivatives& derivatives, int row);

  ContactDynamics& dynamics_;
  MotionDerivatives* motion_ = nullptr;  // of the dynamics, at the solution
  ContactSensitivity result_;
  // Columns q, v, τ, zeros up to a multiple of four: of the residual, of its first nv rows and the contacts'; then of
  // the solution, with the other sign.
  RowMajorMatrix dynamics_by_, rows_by_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_SENSITIVITY_H_
