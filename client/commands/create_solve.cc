#include "client/commands/create_solve.h"

#include <random>

#include "client/failure.h"

namespace rollgait::client {

std::string RandomRequestId() {
  std::random_device source;
  std::uniform_int_distribution<int> digit(0, 15);
  std::string id = "cli-";
  for (int i = 0; i < 32; ++i) id += "0123456789abcdef"[digit(source)];
  return id;
}

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

}  // namespace rollgait::client
