#ifndef ROLLGAIT_CORE_GAIT_INITIAL_GUESS_H_
#define ROLLGAIT_CORE_GAIT_INITIAL_GUESS_H_

#include "core/gait/gait_spec.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// A walk to start from: each leg follows sagittal angles of human walking between its own touch-downs, the hips are
// carried so that the feet in contact touch the ground, arms swing against the legs, velocities are differences, the
// weight shifts linearly between the feet. Works for any phases in which every leg touches down once a cycle. Joints
// are found by role (JointRole) and their sense of flexion by their axis; legs by the side of their contacts. Joints
// without a role stay at zero, where the body stands straight: a leg may have any number of them. Contract: a joint
// kBaseForward and one kBaseVertical.
//   variant  0: as said. From 1 on, another walk each: step length and the angles of hip, knee and ankle are scaled by
//   up to
//            ±25 %, the trunk leans by up to ±10°, drawn from a generator with this number as its seed.
MotionGuess WalkingGuess(const GaitSpec& spec, const OptimalControlProblem& problem, int variant = 0);

// A solution on another mesh, or of a problem like this one.
MotionGuess GuessFromTrajectory(const Trajectory& trajectory);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_INITIAL_GUESS_H_
