#ifndef ROLLGAIT_CORE_VALIDATION_CONTACT_RESIDUALS_H_
#define ROLLGAIT_CORE_VALIDATION_CONTACT_RESIDUALS_H_

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/findings.h"
#include "core/validation/force_judge.h"

namespace rollgait {

// What the returned trajectory does at its contacts, at every instant.
struct ContactResiduals {
  double max_gap = 0;              // m, |gap| of active contacts
  double max_slip = 0;             // m/s, |w| of active contacts in their directions
  double min_swing_clearance = 0;  // m, least gap of inactive contacts; 0 if every contact is always active
};

// Judges gap, slip, penetration, and the returned forces (pull, friction): the extremes of their polynomials over the
// whole of every interval, from θ = 0 on. Gap and slip are no polynomials; they are interpolated on pieces of the
// interval that are halved, down to 1/1024 of it, until the interpolant is within 1e-4 of the largest value there (or
// 1e-12 m, m/s). Extremes are therefore within 0.1 % of the true ones wherever the functions are smooth on pieces of
// that length.
ContactResiduals MeasureContacts(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                                 const ForceBounds& bounds, ForceExtremes* forces, FindingLog* log);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_CONTACT_RESIDUALS_H_
