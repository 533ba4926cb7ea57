// The way to the server.
#ifndef ROLLGAIT_CLIENT_CONNECTION_H_
#define ROLLGAIT_CLIENT_CONNECTION_H_

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <memory>
#include <string>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::client {

// What applies to every command.
struct GlobalOptions {
  std::string server = "127.0.0.1:50051";
  // PEM files: CA bundle for the server's certificate (empty: the system's), and this client's certificate and key.
  std::string tls_ca, tls_cert, tls_key;
  // File with a bearer token in its first line; empty: the token of `token`.
  std::string token_file, token;
  // Plain text beyond loopback.
  bool insecure = false;
  bool json = false;
  bool quiet = false;
  // RPC deadline of unary calls, s. Streams have none.
  double timeout_s = 30.0;
};

// A channel with keepalive, quick reconnection and no bound on the size of an answer: TLS if the server is beyond
// loopback or a flag of TLS is given, plain text else. Every call carries the token, if there is one. Cheap to make:
// nothing is sent before the first call.
class Connection {
 public:
  // Throws Failure(kUsage) if the address is not HOST:PORT with a port in [1, 65535] (or unix:PATH), a file cannot be
  // read, or a token would go over a network in plain text.
  explicit Connection(const GlobalOptions& options);

  v1::GaitService::StubInterface& stub() { return *stub_; }
  std::shared_ptr<grpc::Channel> channel() const { return channel_; }
  const std::string& server() const { return options_.server; }
  const GlobalOptions& options() const { return options_; }

  // Gives one call the deadline of the options.
  void SetDeadline(grpc::ClientContext& context) const;

  // GetSolve; throws Failure.
  v1::Solve GetSolve(const std::string& name);

 private:
  GlobalOptions options_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::GaitService::Stub> stub_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_CONNECTION_H_
