#ifndef ROLLGAIT_CORE_GAIT_PARAMETER_CONTINUATION_H_
#define ROLLGAIT_CORE_GAIT_PARAMETER_CONTINUATION_H_

#include <functional>
#include <optional>

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"

namespace rollgait {

// A way from a request that has been solved to the one that was asked for, along one parameter: each solution is the
// start of the next (Allgower and Georg, Numerical Continuation Methods, 1990).
struct ParameterContinuation {
  double from = 0, to = 0;  // values of the parameter: of the start, and of the request
  double first_step = 1;
  double least_step = 1;  // below this the continuation gives up
  // The value one step further than `at`; exactly `to` where that is no further.
  std::function<double(double at, double step)> advance;
  // A smaller step, after one that did not converge.
  std::function<double(double step)> shorten;
  // Solves the request with this value from the last solution that converged.
  std::function<GaitSolution(double value, const GaitSolution& last)> solve;
};

struct ContinuationEnd {
  GaitSolution last;  // that converged, or the start
  double reached;     // the value that it belongs to
  // What the last step came to where it did not converge and none was tried after it; its value.
  std::optional<GaitSolution> failed;
  double failed_at = 0;
};

// Follows the continuation until it arrives, its step is too small, or the budget is used up. Contract: `start` has
// converged. Notes of the start are those of every solution after it.
ContinuationEnd Follow(const ParameterContinuation& continuation, GaitSolution start, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_PARAMETER_CONTINUATION_H_
