#ifndef ROLLGAIT_SERVER_SOLVE_LOCAL_SOLVE_H_
#define ROLLGAIT_SERVER_SOLVE_LOCAL_SOLVE_H_

#include <iosfwd>
#include <string>

#include "core/base/stop.h"
#include "core/gait/gait_solver.h"

namespace rollgait::server {

// Exit codes of `rollgait-solve --spec`.
enum LocalExit : int {
  kLocalSolved = 0,       // termination OPTIMAL or ACCEPTABLE, verdict WITHIN or NOT_JUDGED
  kLocalFailed = 1,       // the result cannot be written
  kLocalBadRequest = 2,   // every violation is on `progress`
  kLocalNoSolution = 3,   // a result with another termination
  kLocalMissesBound = 8,  // OPTIMAL or ACCEPTABLE, verdict EXCEEDED
};

// Solves the SolveSpec in `json` (proto3 JSON) in this process. One line an iteration on `progress`, the SolveResult as
// proto3 JSON on `out`.
LocalExit SolveLocally(const std::string& json, GaitSolver& solver, const StopFlag& stop, std::ostream& out,
                       std::ostream& progress);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SOLVE_LOCAL_SOLVE_H_
