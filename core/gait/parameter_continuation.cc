#include "core/gait/parameter_continuation.h"

#include <utility>

namespace rollgait {

ContinuationEnd Follow(const ParameterContinuation& continuation, GaitSolution start, SolveBudget* budget) {
  ContinuationEnd end{.last = std::move(start), .reached = continuation.from, .failed = std::nullopt};
  double step = continuation.first_step;
  while (end.reached != continuation.to) {
    const double next = continuation.advance(end.reached, step);
    GaitSolution solution = continuation.solve(next, end.last);
    solution.note = end.last.note;
    if (Converged(solution.termination)) {
      end.last = std::move(solution);
      end.reached = next;
      continue;
    }
    step = continuation.shorten(step);
    if (step >= continuation.least_step && budget->Left()) continue;
    end.failed = std::move(solution);
    end.failed_at = next;
    break;
  }
  return end;
}

}  // namespace rollgait
