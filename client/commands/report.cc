#include "client/report/report.h"

#include <memory>

#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/commands/solve_iterations.h"
#include "client/failure.h"
#include "client/output.h"

namespace rollgait::client {
ExitCode RunReport(const ReportOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  std::vector<ReportedSolve> solves;
  std::unique_ptr<Connection> connection;
  for (const std::string& given : options.solves) {
    v1::Solve solve = FinishedSolve(given, global, connection);
    std::vector<v1::Iteration> iterations;
    if (!IsSolveFile(given)) iterations = ReadIterations(*connection, solve, terminal);
    if (options.without_people) solve.mutable_result()->clear_normative();
    solves.emplace_back(std::move(solve), std::move(iterations));
  }
  WriteDocument(ReportHtml(solves, options.title), options.output, terminal.out);
  if (!global.quiet && !IsStandardOutput(options.output)) terminal.err << "written: " << options.output << std::endl;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
