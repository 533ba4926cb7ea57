// Computes one gait of the planar human without a server and prints its torques at the knee: one_gait SLOPE_IN_DEGREES.
// Exit code 0: optimal and within the bounds of standard accuracy; 1: not; 2: the request is refused, with every
// reason.
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "core/gait/gait_request.h"
#include "core/gait/optimizing_gait_solver.h"

int main(int count, char** arguments) {
  rollgait::GaitRequest request;
  request.body.model = "planar";
  request.slope = (count > 1 ? std::atof(arguments[1]) : 0) * std::numbers::pi / 180;
  request.motion.speed = 1.3;

  const auto spec = rollgait::CheckRequest(request);
  if (!spec.ok()) {
    for (const auto& violation : spec.violations())
      std::fprintf(stderr, "%s: %s\n", violation.field.c_str(), violation.message.c_str());
    return 2;
  }
  rollgait::SolveControl control;
  control.observer = [](const rollgait::IterationInfo& info) {
    std::fprintf(stderr, "%4d %14.6e\n", info.index, info.objective);
  };
  const rollgait::GaitSolution solution = rollgait::OptimizingGaitSolver().Solve(spec.value(), control);
  std::printf("%s\nobjective %.6g, step %.4f m, speed %.4f m/s\n", solution.message.c_str(), solution.objective,
              solution.step_length, solution.speed);
  return solution.termination == rollgait::Termination::kOptimal && solution.within_requested_accuracy() ? 0 : 1;
}
