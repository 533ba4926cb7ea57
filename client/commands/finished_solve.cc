#include "client/commands/finished_solve.h"

#include <filesystem>

#include "client/failure.h"
#include "client/json.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

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

bool IsSolveFile(const std::string& given) { return std::filesystem::path(given).extension() == ".json"; }

v1::Solve FinishedSolve(const std::string& given, const GlobalOptions& global,
                        std::unique_ptr<Connection>& connection) {
  v1::Solve solve;
  if (IsSolveFile(given)) {
    ReadJsonFile(given, solve);
  } else {
    if (connection == nullptr) connection = std::make_unique<Connection>(global);
    solve = connection->GetSolve(given);
  }
  RequireFinished(solve, given);
  return solve;
}

}  // namespace rollgait::client
