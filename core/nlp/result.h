#ifndef ROLLGAIT_CORE_NLP_RESULT_H_
#define ROLLGAIT_CORE_NLP_RESULT_H_

#include <functional>
#include <string>

#include "core/base/stop.h"
#include "core/base/types.h"

namespace rollgait {

// Why an iterative solve ended. Mirrors rollgait.v1.Termination.
enum class Termination {
  kOptimal,
  kAcceptable,
  kInfeasible,
  kIterationLimit,
  kTimeLimit,
  kNumericalDifficulty,
  kCancelled,
};

// One iteration in Ipopt's terms; see rollgait.v1.Iteration. Of one program each index is reported once, 0, 1, 2 …,
// whichever solver an iteration is of.
struct IterationInfo {
  int index = 0;
  double objective = 0;
  double primal_infeasibility = 0;
  double dual_infeasibility = 0;  // of this point; within restoration, of the problem of restoration
  double barrier_parameter = 0;   // with which the step to this point was computed
  double step_norm = 0;
  double regularization = 0;
  double primal_step = 0;
  double dual_step = 0;
  int line_search_trials = 0;
  bool restoration = false;  // of a restoration phase, or of Ipopt where it has taken over
  double elapsed_s = 0;
  int mesh = 0;
  // The point of the iteration, scaled as the NLP is, for as long as the observer runs.
  const double* x = nullptr;
};

class IterateSink;
class SolutionSink;
class SolveJournal;

// How a running solve is watched, stopped and kept. All may be empty. The observer is called in the solving thread.
struct SolveControl {
  std::function<void(const IterationInfo&)> observer;
  const StopFlag* stop = nullptr;
  SolveJournal* journal = nullptr;    // of a search of several programs: where it goes on from (solve_journal.h)
  IterateSink* iterates = nullptr;    // of a search for a gait: who is shown iterates (core/gait/iterate_sink.h)
  SolutionSink* solutions = nullptr;  // likewise, and solutions (core/gait/newest_solution.h)
};

// The outcome of one NLP: the last (or best feasible) iterate, scaled as the NLP was given.
struct NlpResult {
  Termination termination = Termination::kNumericalDifficulty;
  std::string message;
  VectorX x;
  VectorX constraint_multipliers;
  VectorX lower_bound_multipliers;
  VectorX upper_bound_multipliers;
  double objective = 0;
  double kkt_error = 0;
  double constraint_violation = 0;
  bool rough = false;  // optimal to NlpOptions::rough_tolerance, and not worth finishing
  int iterations = 0;
  int restored_from = -1;  // iteration from which Ipopt took over; -1: never
  double wall_time_s = 0;
  double evaluation_time_s = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_RESULT_H_
