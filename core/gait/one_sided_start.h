#ifndef ROLLGAIT_CORE_GAIT_ONE_SIDED_START_H_
#define ROLLGAIT_CORE_GAIT_ONE_SIDED_START_H_

#include <optional>

#include "core/gait/gait_solver.h"

namespace rollgait {

// The request for one step of the body that left and right of the spec's differ from, to start from. Empty where there
// is none (GaitSpec::symmetric) or HalfCycleOf has none.
std::optional<GaitSpec> SymmetricStepOf(const GaitSpec& spec);

// The full cycle of a step of that body and its mirror image, as a motion of the body of the spec: its joints and
// muscles find theirs by name, those that the other body does not have rest at zero. Without multipliers, with
// the constraints of a cold start. Contract: `step` has a trajectory, of SymmetricStepOf(spec).
WarmStart OneSidedStart(const GaitSpec& spec, const GaitSolution& step);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ONE_SIDED_START_H_
