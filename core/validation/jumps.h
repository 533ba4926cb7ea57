#ifndef ROLLGAIT_CORE_VALIDATION_JUMPS_H_
#define ROLLGAIT_CORE_VALIDATION_JUMPS_H_

#include <vector>

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/force_judge.h"

namespace rollgait {

// Whether velocities jump where the phase starts.
inline bool Jumps(const TrajectoryPhase& phase) { return phase.impulses.size() > 0; }

// Velocities (nv) before the jump at the start of a phase: those of the last node before it; before the first phase
// those of the last node of all, mirrored in a half cycle.
VectorX VelocityBefore(const Model& model, const Trajectory& trajectory, int phase);

struct JumpErrors {
  // Largest difference between the velocities after a jump and those that a plastic impact in the contacts of the new
  // phase (ResolveImpact) makes of the velocities before it, rad/s or m/s.
  double velocity = 0;
  double impulse = 0;  // N s, largest |Σ impulses − change of linear momentum|
  double loss = 0;     // J, kinetic energy lost in all jumps
};

// Judges every jump and adds its impulses to `impulses`, whose weight is in N s. The log gets velocity errors as
// defects of velocity, impulse errors over the mass as errors of momentum, and pull and friction of the impulses
// (impulses may not pull at all).
JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, double friction,
                        ForceExtremes* impulses, FindingLog* log);
// Without a log and a bound for friction.
JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        ForceExtremes* impulses);

// Contacts (indices into the scene's) that a phase has and the phase before it has not: before the first phase comes
// the last one, mirrored in a half cycle; in a motion that is not periodic nothing touches down there.
std::vector<int> TouchDowns(const Scene& scene, const Trajectory& trajectory, int phase);

// Judges every touch-down: the speed at which the surface rises at its contact point just before it, max(0, n·v⁻), m/s.
// Returns the largest.
double MeasureApproach(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, FindingLog* log);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_JUMPS_H_
