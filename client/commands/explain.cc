#include <memory>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/commands/solve_iterations.h"
#include "client/explanation.h"

namespace rollgait::client {

ExitCode RunExplain(const ExplainOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (global.json) {
    throw Failure(ExitCode::kUsage,
                  "explain --json: sentences have no JSON; `rollgait get SOLVE --json` has the solve");
  }
  std::unique_ptr<Connection> connection;
  const v1::Solve solve = FinishedSolve(options.solve, global, connection);
  std::vector<v1::Iteration> iterations;
  if (!IsSolveFile(options.solve)) iterations = ReadIterations(*connection, solve, terminal);
  terminal.out << Explain(solve, iterations) << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
