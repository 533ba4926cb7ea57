#ifndef ROLLGAIT_CORE_GAIT_RATE_CONTINUATION_H_
#define ROLLGAIT_CORE_GAIT_RATE_CONTINUATION_H_

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// Whether squared torque is among the costs, and neither powers nor rates are. Efforts are then free to jump at every
// point, and long valleys lead away from the motions of walking, on coarse meshes to such as exist at the points only.
bool LeavesRatesFree(const GaitSpec& spec);

// The spec with a small weight of the rates of torques, about a hundredth of the objective of a walk, to a tolerance
// that does for a start; meshes are refined as the spec asks. From the built-in guess it takes 40 to 60 iterations.
// Pre-condition: LeavesRatesFree(spec).
GaitSpec WithRates(const GaitSpec& spec);

// The solution of WithRates(spec) from one of the spec on a mesh that does not do.
GaitSolution AddRates(const GaitSpec& spec, const GaitSolution& solution, SolveBudget* budget);

// From the solution of WithRates(spec) to that of the spec, by tenths of the weight and at last without: each solution
// is the warm start of the next, and the last one is refined as the spec asks. Where one does not converge: what came
// of it. Pre-condition: `rated` has converged.
GaitSolution ReleaseRates(const GaitSpec& spec, GaitSolution rated, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_RATE_CONTINUATION_H_
