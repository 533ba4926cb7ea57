#ifndef ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_
#define ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_

#include "core/trajectory/trajectory.h"

namespace rollgait {

// The motion at one instant.
struct MotionSample {
  VectorX position;      // nq
  VectorX velocity;      // nq
  VectorX acceleration;  // nq
  VectorX efforts;       // n_actuated
  VectorX forces;        // 3 · active contacts
};

// Evaluates the trajectory in interval `interval` of phase `phase` at fraction θ ∈ [0, 1] of the interval, by the rule that
// Trajectory states. Contract: indices in range.
MotionSample Sample(const Trajectory& trajectory, int phase, int interval, double theta);

// Efforts alone, for integrators that call it often.
VectorX SampleEfforts(const Trajectory& trajectory, int phase, int interval, double theta);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_
