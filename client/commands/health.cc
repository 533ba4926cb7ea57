// health: grpc.health.v1.Health/Check, for container engines and scripts.
#include <grpcpp/channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <string>
#include <vector>

#include "client/commands/commands.h"

namespace rollgait::client {
namespace {

// HealthCheckResponse is one field, `ServingStatus status = 1`; SERVING is 1. Absent: UNKNOWN.
const std::string kServing = "\x08\x01";

// Calls Check with the empty request: the server as a whole. Returns the bytes of the answer.
std::string Check(const Connection& connection) {
  grpc::GenericStub stub(connection.channel());
  grpc::ClientContext context;
  connection.SetDeadline(context);
  grpc::CompletionQueue queue;
  const grpc::Slice empty;
  auto call = stub.PrepareUnaryCall(&context, "/grpc.health.v1.Health/Check", grpc::ByteBuffer(&empty, 1), &queue);
  call->StartCall();
  grpc::ByteBuffer response;
  grpc::Status status;
  call->Finish(&response, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  RequireOk(status, "ask for its health", connection.server());
  std::vector<grpc::Slice> slices;
  std::string bytes;
  if (!response.Dump(&slices).ok()) return bytes;
  for (const grpc::Slice& slice : slices) bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return bytes;
}

}  // namespace

ExitCode RunHealth(const GlobalOptions& global, const Terminal& terminal) {
  const Connection connection(global);
  if (Check(connection) != kServing) {
    throw Failure(ExitCode::kUnreachable,
                  "the server at " + global.server + " answers, but is not serving (it starts or stops)");
  }
  if (!global.quiet) terminal.out << "serving" << std::endl;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
