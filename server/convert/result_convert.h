#ifndef ROLLGAIT_SERVER_CONVERT_RESULT_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_RESULT_CONVERT_H_

#include "core/gait/gait_solver.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::server {

v1::Cycle EncodeCycle(Cycle cycle);

v1::Iteration EncodeIteration(const IterationInfo& iteration);

v1::Trajectory EncodeTrajectory(const Trajectory& trajectory, const Scene& scene);

// The whole answer except what only the parent of the process can measure (cpu_time_s, peak_memory_bytes) and
// solver_build.
v1::SolveResult EncodeResult(const GaitSolution& solution, const GaitSpec& spec);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_RESULT_CONVERT_H_
