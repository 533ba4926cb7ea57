#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/output.h"

namespace rollgait::client {

ExitCode RunExport(const ExportOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (options.format.empty() && (options.output.empty() || options.output == "-")) {
    throw Failure(ExitCode::kUsage, "--format: is needed for standard output; one of " + SolveFormatNames());
  }
  const Format& format = options.format.empty() ? FormatOfPath(options.output, "--output") : FindFormat(options.format);
  RequireOutput(options.output, format);
  std::unique_ptr<Connection> connection;
  const v1::Solve solve = FinishedSolve(options.solve, global, connection);
  WriteExport(ExportSolve(solve, format), options.output, terminal.out);
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
