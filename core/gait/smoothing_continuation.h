#ifndef ROLLGAIT_CORE_GAIT_SMOOTHING_CONTINUATION_H_
#define ROLLGAIT_CORE_GAIT_SMOOTHING_CONTINUATION_H_

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// A cold start seldom converges where the cost of power has a sharp corner; with this smoothing, W, it does
// (docs/explanation/walking.md): 40 W at 75 kg and 9.81 m/s², in proportion to the powers of walking.
inline double ColdSmoothing(const GaitSpec& spec) { return 40 * spec.similarity.power(); }

// Follows a solution that converged with powers smoothed by ColdSmoothing to the spec: an eighth of the smoothing at a
// time, smaller steps where one does not converge. If the spec is not reached: what stopped the last step, and a
// message that says how far it came.
GaitSolution ReduceSmoothing(const GaitSpec& spec, GaitSolution smooth, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SMOOTHING_CONTINUATION_H_
