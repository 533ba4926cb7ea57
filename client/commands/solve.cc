#include <random>

#include "client/commands/commands.h"
#include "client/commands/follow.h"
#include "client/json.h"
#include "client/output.h"

namespace rollgait::client {
namespace {

// An id that no other request has, so that a creation whose answer was lost can be repeated.
std::string RandomRequestId() {
  std::random_device source;
  std::uniform_int_distribution<int> digit(0, 15);
  std::string id = "cli-";
  for (int i = 0; i < 32; ++i) id += "0123456789abcdef"[digit(source)];
  return id;
}

// Creates the solve. A connection that breaks after the request was sent is tried once more: the request id makes that
// safe.
v1::Solve CreateSolve(Connection& connection, const v1::CreateSolveRequest& request) {
  const std::string action = request.validate_only() ? "validate the request" : "create the solve";
  v1::Solve solve;
  grpc::Status status;
  for (int attempt = 0; attempt < 2; ++attempt) {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    status = connection.stub().CreateSolve(&context, request, &solve);
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE) break;
  }
  RequireOk(status, action, connection.server());
  return solve;
}

}  // namespace

ExitCode RunSolve(const SolveOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.output.empty()) RequireOutputPath(options.output);
  if (options.detach && !options.output.empty()) {
    throw Failure(ExitCode::kUsage, "--output with --detach: there is nothing to write yet; later use `rollgait get`");
  }
  v1::CreateSolveRequest request;
  *request.mutable_spec() = BuildSpec(options.spec);
  request.set_request_id(options.request_id.empty() ? RandomRequestId() : options.request_id);
  request.set_validate_only(options.validate_only);

  Progress progress(terminal, ProgressStyle(global, terminal));
  if (options.validate_only || options.detach) {
    Connection connection(global);
    const v1::Solve solve = CreateSolve(connection, request);
    if (global.json) {
      terminal.out << ToJsonLine(solve) << std::endl;
    } else if (options.detach) {
      terminal.out << solve.name() << std::endl;
    } else if (!global.quiet) {
      terminal.out << "the request is valid" << std::endl;
    }
    return ExitCode::kSuccess;
  }
  CtrlC ctrl_c(CtrlC::Action::kCancelSolve, progress);
  Connection connection(global);
  const v1::Solve solve = CreateSolve(connection, request);
  if (!global.json) progress.Note(solve.name());
  return FollowToEnd(connection, solve.name(), {0, options.reconnect_s}, options.output, ctrl_c, progress, terminal);
}

}  // namespace rollgait::client
