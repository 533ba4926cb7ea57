#ifndef ROLLGAIT_CORE_VALIDATION_JUMPS_H_
#define ROLLGAIT_CORE_VALIDATION_JUMPS_H_

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/residuals.h"

namespace rollgait {

// Whether velocities jump where the phase starts.
inline bool Jumps(const TrajectoryPhase& phase) { return phase.impulses.size() > 0; }

// Velocities (nv) before the jump at the start of a phase: those of the last node before it; before the first phase those of the
// last node of all, mirrored in a half cycle.
VectorX VelocityBefore(const Model& model, const Trajectory& trajectory, int phase);

struct JumpErrors {
  // Largest difference between the velocities after a jump and those that a plastic impact in the contacts of the new phase
  // (ResolveImpact) makes of the velocities before it, rad/s or m/s.
  double velocity = 0;
  double impulse = 0;  // N s, largest |Σ impulses − change of linear momentum|
  double loss = 0;     // J, kinetic energy lost in all jumps
};

// Judges every jump and adds its impulses to `impulses`, whose weight is in N s.
JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        ForceExtremes* impulses);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_JUMPS_H_
