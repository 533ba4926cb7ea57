#include "client/report/report.h"

#include <memory>

#include "client/commands/commands.h"
#include "client/commands/finished_solve.h"
#include "client/failure.h"
#include "client/output.h"

namespace rollgait::client {
namespace {

// The lines of the solver's log that the server still holds.
std::vector<v1::Iteration> Iterations(Connection& connection, const v1::Solve& solve, const Terminal& terminal) {
  std::vector<v1::Iteration> iterations;
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::WatchSolveRequest request;
  request.set_name(solve.name());
  const auto stream = connection.stub().WatchSolve(&context, request);
  v1::SolveEvent event;
  while (stream->Read(&event)) {
    if (event.has_iteration()) iterations.push_back(event.iteration());
  }
  const grpc::Status status = stream->Finish();
  if (status.error_code() == grpc::StatusCode::OUT_OF_RANGE) {
    terminal.err << solve.name() << ": the server no longer holds its iterations; the page shows its meshes only"
                 << std::endl;
    return {};
  }
  RequireOk(status, "read the iterations of " + solve.name(), connection.server());
  return iterations;
}

}  // namespace

ExitCode RunReport(const ReportOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  std::vector<ReportedSolve> solves;
  std::unique_ptr<Connection> connection;
  for (const std::string& given : options.solves) {
    v1::Solve solve = FinishedSolve(given, global, connection);
    std::vector<v1::Iteration> iterations;
    if (!IsSolveFile(given)) iterations = Iterations(*connection, solve, terminal);
    if (options.without_people) solve.mutable_result()->clear_normative();
    solves.emplace_back(std::move(solve), std::move(iterations));
  }
  WriteDocument(ReportHtml(solves, options.title), options.output, terminal.out);
  if (!global.quiet && !IsStandardOutput(options.output)) terminal.err << "written: " << options.output << std::endl;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
