#include "client/report/report.h"

#include <filesystem>
#include <memory>

#include "client/commands/commands.h"
#include "client/json.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

bool IsFile(const std::string& solve) { return std::filesystem::path(solve).extension() == ".json"; }

void RequireFinished(const v1::Solve& solve, const std::string& given) {
  switch (solve.state()) {
    case v1::SOLVE_STATE_SUCCEEDED:
    case v1::SOLVE_STATE_FAILED:
    case v1::SOLVE_STATE_CANCELLED:
      return;
    default:
      throw Failure(ExitCode::kUsage, given + " is " + StateName(solve.state()) +
                                          "; wait for its end with `rollgait watch " + given + "`");
  }
}

}  // namespace

ExitCode RunReport(const ReportOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  std::vector<v1::Solve> solves;
  std::unique_ptr<Connection> connection;
  for (const std::string& given : options.solves) {
    v1::Solve solve;
    if (IsFile(given)) {
      ReadJsonFile(given, solve);
    } else {
      if (connection == nullptr) connection = std::make_unique<Connection>(global);
      solve = connection->GetSolve(given);
    }
    RequireFinished(solve, given);
    if (options.without_people) solve.mutable_result()->clear_normative();
    solves.push_back(std::move(solve));
  }
  WriteFile(options.output, ReportHtml(solves, options.title));
  if (!global.quiet) terminal.err << "written: " << options.output << std::endl;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
