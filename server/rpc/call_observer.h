#ifndef ROLLGAIT_SERVER_RPC_CALL_OBSERVER_H_
#define ROLLGAIT_SERVER_RPC_CALL_OBSERVER_H_

#include <grpcpp/support/server_interceptor.h>

#include <atomic>
#include <cstdint>
#include <memory>

#include "server/base/rate_limit.h"
#include "server/rpc/rpc_metrics.h"

namespace rollgait::server {

// Sees every call of a server, whatever serves it: counts it, gives it a CallRecord while it lives and a line in the
// log at its end
// ("call.finished"). Each call gets a request id and a traceparent: the client's metadata x-request-id (at most 128
// printable characters) and traceparent (W3C) where they are good, else new ones. The request id goes back in the
// initial metadata.
//
// Level of the line: error for INTERNAL, UNKNOWN and DATA_LOSS; info for refusals and for what changes or watches a
// solve; debug for what only reads. Of refusals at most 50 lines a second are written; `suppressed` tells how many were
// not.
class CallObserver : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  // Metrics outlive the server. Behind a door (door.h) it is the door that knows the peer, and it is told in the
  // initial metadata of an answer when that is UNAUTHENTICATED.
  explicit CallObserver(Metrics& metrics, bool behind_door = false)
      : shared_(std::make_shared<Shared>(metrics, behind_door)) {}
  grpc::experimental::Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* info) override;

 private:
  class Call;
  struct Shared {
    Shared(Metrics& metrics, bool door) : rpc(metrics), behind_door(door) {}

    RpcMetrics rpc;
    const bool behind_door;
    RateLimit refusals{50};  // lines a second: a screenful, and 0.2 KB each
  };
  const std::shared_ptr<Shared> shared_;  // calls may outlive the builder's list of observers
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_CALL_OBSERVER_H_
