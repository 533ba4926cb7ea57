#ifndef ROLLGAIT_CORE_GAIT_MULTISTART_H_
#define ROLLGAIT_CORE_GAIT_MULTISTART_H_

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"
#include "core/ocp/problem.h"

namespace rollgait {

// The cheapest of what the first mesh finds from the spec's number of guesses (WalkingGuess), then refined. Its note
// says how many were found and which it is.
GaitSolution SolveFromStarts(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MULTISTART_H_
