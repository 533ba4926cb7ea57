#ifndef ROLLGAIT_CORE_GAIT_ERROR_ESTIMATE_H_
#define ROLLGAIT_CORE_GAIT_ERROR_ESTIMATE_H_

#include <string>
#include <vector>

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// The estimate from a solution and the one on the mesh that halves its intervals. Every entry is the difference of the
// two, times √2: where the error falls by 2^p from one mesh to the next, the difference is 1 − 2^−p of it, between a
// half (p = 1, as where limits begin to act within an interval) and all of it (large p), and √2 is in the middle of
// what is then missing. So an entry is 0.71 to 1.41 of the true error, as far as the meshes are fine enough to have an
// order. Contract: the solution has a trajectory, and both have the same phases.
ErrorEstimate EstimateErrors(const Scene& scene, const GaitSolution& solution, const FinerSolution& finer);

// The largest of the estimates over what the request allows; 0 where it asks for none.
double WorstShareOf(const MaxError& allowed, const ErrorEstimate& errors);

// Solves a converged solution's problem again on the halved mesh, so that its errors can be estimated (`finer`), and
// with a max_error goes on to the finer solution until the estimates are within it, the next mesh would have more than
// 1000 intervals, the finer solution exceeds a bound that the answer keeps, or the budget is used up. Where the finer
// program does not converge, or is not solved, the message says why. A stop leaves the termination kCancelled.
// Contract: the spec has no manoeuvre.
GaitSolution SolveForErrors(const GaitSpec& spec, GaitSolution solution, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ERROR_ESTIMATE_H_
