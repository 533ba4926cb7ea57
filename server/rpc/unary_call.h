#ifndef ROLLGAIT_SERVER_RPC_UNARY_CALL_H_
#define ROLLGAIT_SERVER_RPC_UNARY_CALL_H_

#include <grpcpp/grpcpp.h>

#include <memory>
#include <utility>

#include "server/access/gatekeeper.h"

namespace rollgait::server {

// A unary call whose admission lasts until gRPC has written its answer, or the client has gone. Deletes itself then.
class UnaryCall : public grpc::ServerUnaryReactor {
 public:
  // Before Finish.
  void Keep(std::shared_ptr<Admission> admission) { admission_ = std::move(admission); }
  void OnDone() override { delete this; }

 private:
  std::shared_ptr<Admission> admission_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_UNARY_CALL_H_
