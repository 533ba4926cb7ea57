#ifndef ROLLGAIT_CORE_GAIT_JUDGE_SOLUTION_H_
#define ROLLGAIT_CORE_GAIT_JUDGE_SOLUTION_H_

#include "core/gait/gait_solver.h"

namespace rollgait {

bool Converged(Termination termination);

// Fills accuracy and verdict of a solution with a trajectory, by the bounds of the spec; one that did not converge has
// no verdict.
// Whether an optimal motion like this one would be within every bound of the request.
bool IsWithinBounds(const GaitSpec& spec, const Trajectory& trajectory);

void Judge(const GaitSpec& spec, GaitSolution* solution);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_JUDGE_SOLUTION_H_
