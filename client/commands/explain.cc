#include <memory>

#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/explanation.h"

namespace rollgait::client {

ExitCode RunExplain(const ExplainOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (global.json) {
    throw Failure(ExitCode::kUsage,
                  "explain --json: sentences have no JSON; `rollgait get SOLVE --json` has the solve");
  }
  std::unique_ptr<Connection> connection;
  terminal.out << Explain(FinishedSolve(options.solve, global, connection)) << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
