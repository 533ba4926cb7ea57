#include "client/connection.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <charconv>
#include <chrono>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

void RequireAddress(const std::string& server) {
  if (server.rfind("unix:", 0) == 0 && server.size() > 5) return;
  const size_t colon = server.rfind(':');
  int port = 0;
  if (colon != std::string::npos && colon > 0) {
    const char* end = server.data() + server.size();
    const auto parsed = std::from_chars(server.data() + colon + 1, end, port);
    if (parsed.ec == std::errc() && parsed.ptr == end && port >= 1 && port <= 65535) return;
  }
  throw Failure(ExitCode::kUsage,
                "--server " + server + ": must be HOST:PORT with a port in [1, 65535], for example 127.0.0.1:50051");
}

}  // namespace

Connection::Connection(const GlobalOptions& options) : options_(options) {
  RequireAddress(options.server);
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2000);
  arguments.SetUserAgentPrefix("rollgait/" ROLLGAIT_VERSION);
  channel_ = grpc::CreateCustomChannel(options.server, grpc::InsecureChannelCredentials(), arguments);
  stub_ = v1::GaitService::NewStub(channel_);
}

void Connection::SetDeadline(grpc::ClientContext& context) const {
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::milliseconds(static_cast<int64_t>(options_.timeout_s * 1e3)));
}

v1::Solve Connection::GetSolve(const std::string& name) {
  grpc::ClientContext context;
  SetDeadline(context);
  v1::GetSolveRequest request;
  request.set_name(SolveName(name));
  v1::Solve solve;
  RequireOk(stub_->GetSolve(&context, request, &solve), "get " + request.name(), server());
  return solve;
}

}  // namespace rollgait::client
