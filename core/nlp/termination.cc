#include "core/nlp/termination.h"

#include "core/base/check.h"

namespace rollgait {

const char* WordOf(Termination termination) {
  switch (termination) {
    case Termination::kOptimal:
      return "optimal";
    case Termination::kAcceptable:
      return "acceptable";
    case Termination::kInfeasible:
      return "infeasible";
    case Termination::kIterationLimit:
      return "iterations";
    case Termination::kTimeLimit:
      return "time";
    case Termination::kNumericalDifficulty:
      return "numerics";
    case Termination::kCancelled:
      return "cancelled";
  }
  ROLLGAIT_CHECK(false);
}

std::string Explain(Termination termination) {
  switch (termination) {
    case Termination::kOptimal:
      return "The optimality conditions hold to the requested tolerance.";
    case Termination::kAcceptable:
      return "No further progress; the optimality conditions hold to 100 times the requested tolerance.";
    case Termination::kInfeasible:
      return "No motion near the last iterate meets all constraints; unmet_constraints names the worst.";
    case Termination::kIterationLimit:
      return "The iteration limit was reached before convergence.";
    case Termination::kTimeLimit:
      return "The time limit was reached; raise solver_limits.max_wall_time_s or use a coarser mesh.";
    case Termination::kNumericalDifficulty:
      return "The solver could make no further progress.";
    case Termination::kCancelled:
      return "The solve was cancelled.";
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
