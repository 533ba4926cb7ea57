#ifndef ROLLGAIT_CORE_VALIDATION_JOINT_LIMITS_H_
#define ROLLGAIT_CORE_VALIDATION_JOINT_LIMITS_H_

#include "core/multibody/model.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/findings.h"

namespace rollgait {

// Judges ranges, velocities and efforts of the joints against the model's limits by the extrema of the interval
// polynomials (exact, RangeOnUnitInterval), so at every instant:
//   kJointRange     how far a position is past position_min or position_max, rad or m
//   kJointVelocity  (|v| − velocity_max) / velocity_max
//   kJointEffort    how far an effort is past effort_min or effort_max, over the size of that limit; if that is zero,
//   over the
//                   larger of the two
// Infinite limits are not judged.
void MeasureJointLimits(const Model& model, const Trajectory& trajectory, FindingLog* log);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_JOINT_LIMITS_H_
