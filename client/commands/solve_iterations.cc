#include "client/commands/solve_iterations.h"

#include "client/failure.h"

namespace rollgait::client {

std::vector<v1::Iteration> ReadIterations(Connection& connection, const v1::Solve& solve, const Terminal& terminal) {
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
    terminal.err << solve.name() << ": the server no longer holds its iterations; only its meshes are shown"
                 << std::endl;
    return {};
  }
  RequireOk(status, "read the iterations of " + solve.name(), connection.server());
  return iterations;
}

}  // namespace rollgait::client
