#ifndef ROLLGAIT_SERVER_RPC_STATUS_H_
#define ROLLGAIT_SERVER_RPC_STATUS_H_

#include <grpcpp/support/status.h>

#include "server/base/outcome.h"

namespace rollgait::server {

// The RPC status of an error. Violations go as google.rpc.BadRequest, a quota as google.rpc.QuotaFailure, a time to try
// again as google.rpc.RetryInfo, all in grpc-status-details-bin. Clients take 8 KiB of headers by default: texts are
// cut to kMaxText bytes, and violations are left out from where they exceed kMaxDetailBytes (the message tells how many
// there are).
grpc::Status ToStatus(const Error& error);

inline constexpr size_t kMaxText = 300;
inline constexpr size_t kMaxDetailBytes = 4000;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_STATUS_H_
