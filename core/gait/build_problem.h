#ifndef ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_
#define ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_

#include <memory>

#include "core/gait/gait_spec.h"
#include "core/ocp/problem.h"

namespace rollgait {

// The optimal control problem of a checked request; of one with a manoeuvre without its ends, which depend on the chart
// of the orientation. On the heap: its parts refer to one another.
std::unique_ptr<OptimalControlProblem> BuildProblem(const GaitSpec& spec);

// kg m² rad: moment of inertia about the ground times the angle by which a manoeuvre turns the body at least, for
// scales.
double TurningMoment(const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_
