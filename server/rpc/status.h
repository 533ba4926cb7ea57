#ifndef ROLLGAIT_SERVER_RPC_STATUS_H_
#define ROLLGAIT_SERVER_RPC_STATUS_H_

#include <grpcpp/support/status.h>

#include "server/base/outcome.h"

namespace rollgait::server {

// The RPC status of an error. Violations go as google.rpc.BadRequest, a time to try again as google.rpc.RetryInfo, both
// in grpc-status-details-bin; at most kMaxViolations of them and texts cut to kMaxText bytes, because clients bound the
// size of headers.
grpc::Status ToStatus(const Error& error);

inline constexpr size_t kMaxViolations = 20;
inline constexpr size_t kMaxText = 300;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_STATUS_H_
