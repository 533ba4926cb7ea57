#ifndef ROLLGAIT_CORE_GAIT_SLOPE_CONTINUATION_H_
#define ROLLGAIT_CORE_GAIT_SLOPE_CONTINUATION_H_

#include <optional>

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// Walks from level ground to the slope of the spec, 5° at a time, each solution the guess of the next; steps are halved
// where one does not converge, three times at most. Says so in the note. Nothing if level ground or the slope is not
// reached.
std::optional<GaitSolution> SolveFromLevelGround(const GaitSpec& spec, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SLOPE_CONTINUATION_H_
