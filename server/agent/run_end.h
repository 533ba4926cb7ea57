#ifndef ROLLGAIT_SERVER_AGENT_RUN_END_H_
#define ROLLGAIT_SERVER_AGENT_RUN_END_H_

#include <optional>
#include <string>
#include <variant>

#include "server/agent/running_solver.h"
#include "server/base/wire.pb.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// What is known of a solver process when it is gone.
struct RunFacts {
  std::optional<wire::SolverMessage> last;  // a result or an error; nullopt: none arrived whole
  ProcessEnd process;
  FrameStatus stream = FrameStatus::kEnd;  // how its stream ended
  // A program of the request's gait had converged: a result that was cut short has its solution.
  bool has_solution = false;
  bool cancelled = false;    // we asked it to stop because a client wanted that
  bool out_of_time = false;  // we killed it because it did not stop at its wall time
  bool taken = false;        // the request had arrived, or it was we who killed it
  double cpu_limit_s = 0;
  std::string output;  // the last it printed
};

// Give the solve up, so that the store decides on another attempt.
struct Crash {
  std::string detail;
  bool began = true;  // false: the solver was killed before the request arrived, which says nothing of the request
};

// Judges the end of a run: a result is an answer whatever the exit status; an exit without one is a crash whatever the
// exit status (MUMPS stops with status 0). A result that was cut short by a cancellation is no answer; it goes with the
// cancelled end if it has a solution.
std::variant<SolveEnd, Crash> JudgeRun(RunFacts facts);

// A failed or cancelled end.
SolveEnd EndWithError(SolveState state, v1::SolveError::Kind kind, const std::string& message);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_RUN_END_H_
