#ifndef ROLLGAIT_CORE_GAIT_GAIT_SEARCH_H_
#define ROLLGAIT_CORE_GAIT_GAIT_SEARCH_H_

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// Solves a request of a gait in its own units (own_units.h): from its warm start, if there is one, and without it where
// that does not converge. A cold search takes the first of these ways that answers:
//   a full cycle that may mirror itself    one step, then both from it and its image
//   a body whose sides differ              one step of the body with both sides alike, then both from it and its image
//   squared torque without rates           as it is; where that fails, with rates that are then released
//   all others                             a coarse mesh, then finer ones; powers smoothed first; on slopes that the
//                                          starts do not reach, from level ground
// What each way leads through are continuations (parameter_continuation.h) in the smoothing of powers, the weight of
// rates, the slope and the mesh. The budget's log has every program.
GaitSolution SearchGait(const GaitSpec& spec, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_GAIT_SEARCH_H_
