#ifndef ROLLGAIT_CORE_VALIDATION_RESIMULATION_H_
#define ROLLGAIT_CORE_VALIDATION_RESIMULATION_H_

#include <vector>

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/findings.h"
#include "core/validation/force_judge.h"

namespace rollgait {

// A largest difference, and where it occurs.
struct Defect {
  double value = 0;  // rad or m, rad/s or m/s; infinite if the interval could not be integrated
  int joint = 0;
  double time = 0;  // s, end of the interval
};

struct Resimulation {
  Defect position, velocity;  // largest of all
  // Largest difference of each interval, in order of time, against its own next node alone; infinite if it could not be
  // integrated.
  std::vector<double> interval_positions, interval_velocities;
};

// Integrates every mesh interval from its own start node with the trajectory's efforts, the phase's contacts held
// rolling at acceleration level, and compares the end with the next node; at the end of a phase also with the first
// node of the next phase, and at the end of a periodic trajectory also with PeriodicEnd; with positions alone where
// velocities jump (jumps.h). `tolerance` > 0 is relative and absolute. An interval that
// takes more than `most_steps` is not integrated. The log gets the differences of all joints.
//
// The contact forces of the re-integrated motion are judged at every instant: in each accepted step forward dynamics is
// evaluated on the integrator's continuous extension, forces are interpolated there (Pieces, halved until they are
// known to a thousandth of the contact's least normal force, or of a thousandth of the weight) and their extremes are
// sought on at least 48 instants and between them. They go to `forces` and to the log.
Resimulation Resimulate(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        const Vector3& gravity, double tolerance, int most_steps, const ForceBounds& bounds,
                        ForceExtremes* forces, FindingLog* log);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_RESIMULATION_H_
