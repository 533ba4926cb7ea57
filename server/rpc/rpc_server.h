#ifndef ROLLGAIT_SERVER_RPC_RPC_SERVER_H_
#define ROLLGAIT_SERVER_RPC_RPC_SERVER_H_

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>

#include "server/access/gatekeeper.h"
#include "server/base/executor.h"
#include "server/base/metrics.h"
#include "server/base/outcome.h"
#include "server/rpc/admin_server.h"
#include "server/rpc/connection_acceptor.h"
#include "server/rpc/gait_service.h"
#include "server/rpc/tls_files.h"
#include "server/service/solve_service.h"
#include "server/service/watch_hub.h"
#include "server/simulate/simulation_host.h"

namespace rollgait::server {

struct RpcOptions {
  std::string listen = "127.0.0.1:0";  // HOST:PORT, port 0: any free one; or unix:PATH
  bool behind_door = false;            // `listen` is a unix socket, mode 0660, and metadata say who calls: door.h
  TlsFiles tls;                        // without a certificate: plain text
  CertificateTenant certificate_tenant = CertificateTenant::kNone;
  ConnectionLimits connections;               // not of unix sockets
  std::string admin_directory;                // admin.sock is made there; empty: none
  bool discovery = true;                      // health and reflection on the public port too; they ask for no token
  int executor_threads = 8;                   // calls that may touch the store at once
  size_t max_waiting_calls = 4096;            // more are refused with RESOURCE_EXHAUSTED
  std::chrono::milliseconds slow_write{250};  // a longer write marks its reader as slow
  Metrics* metrics = nullptr;        // counts calls; outlives the server; null: calls are neither counted nor logged
  SimulationHostOptions simulation;  // without a program: Simulate answers UNAVAILABLE
};

// The listening gRPC server: GaitService, and grpc.health.v1.Health and reflection where they are offered.
class RpcServer {
 public:
  // Binds and serves. kUnavailable if the address cannot be bound, kInvalidArgument for TLS files. Service, hub and
  // gatekeeper outlive it.
  static Outcome<std::unique_ptr<RpcServer>> Start(const RpcOptions& options, SolveService& service, WatchHub& hub,
                                                   Gatekeeper& gatekeeper);
  ~RpcServer();

  // "HOST:PORT" with the port that was bound.
  const std::string& address() const { return address_; }
  // Health says NOT_SERVING, new calls are refused and streams end with UNAVAILABLE, unary calls have `grace` to
  // finish; then everything is cancelled. Returns when no call is left.
  void Stop(std::chrono::milliseconds grace);

 private:
  RpcServer(const RpcOptions& options, SolveService& service, WatchHub& hub, Gatekeeper& gatekeeper);
  Outcome<Done> Open(const RpcOptions& options);

  WatchHub& hub_;
  Gatekeeper& gatekeeper_;
  Executor executor_;
  SimulationHost simulations_;
  GaitServiceRpc rpc_;
  std::shared_ptr<grpc::ServerCredentials> credentials_;
  std::unique_ptr<ConnectionAcceptor> acceptor_;
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<AdminServer> admin_;
  std::string address_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_RPC_SERVER_H_
