#ifndef ROLLGAIT_CORE_GAIT_HALF_CYCLE_H_
#define ROLLGAIT_CORE_GAIT_HALF_CYCLE_H_

#include <optional>

#include "core/gait/gait_solver.h"

namespace rollgait {

// The request for the first step of a full cycle whose second step may be the mirror image of the first: half the
// unknowns, and no motions that limp. Empty where left and right differ in what the request says: in the body, a limit,
// a weight, the phases; and where motions are tracked, other than a position that is held on both sides.
std::optional<GaitSpec> HalfCycleOf(const GaitSpec& spec);

// The full cycle that a step and its mirror image make, for the spec to start from; its overlapping pairs are those of
// the step. Without multipliers. Contract: `half` has a trajectory, of HalfCycleOf(spec).
WarmStart BothSteps(const GaitSpec& spec, const GaitSolution& half);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_HALF_CYCLE_H_
