#ifndef ROLLGAIT_CORE_GAIT_SHARPENING_H_
#define ROLLGAIT_CORE_GAIT_SHARPENING_H_

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// From afar a price of power with a sharp corner seldom converges; with this smoothing, W, it does (docs/walking.md).
inline constexpr double kSmoothingFromAfar = 40;

// Follows a solution that converged with powers smoothed by kSmoothingFromAfar to the spec: an eighth of the smoothing at a time, each
// solution the warm start of the next; smaller steps where one does not converge. The meshes list every program from `smooth`
// on. If the spec is not reached: what stopped the last step, and a message that says how far it came.
GaitSolution Sharpen(const GaitSpec& spec, GaitSolution smooth, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SHARPENING_H_
