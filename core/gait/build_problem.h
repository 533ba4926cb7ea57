#ifndef ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_
#define ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_

#include <memory>

#include "core/gait/gait_request.h"
#include "core/ocp/problem.h"

namespace rollgait {

// The optimal control problem of a checked request. On the heap: its parts refer to one another.
std::unique_ptr<OptimalControlProblem> BuildProblem(const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_BUILD_PROBLEM_H_
