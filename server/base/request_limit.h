#ifndef ROLLGAIT_SERVER_BASE_REQUEST_LIMIT_H_
#define ROLLGAIT_SERVER_BASE_REQUEST_LIMIT_H_

#include <cstdint>

namespace rollgait::server {

// Bytes of one request, as a message of gRPC and as a body of HTTP; ServerInfo.max_request_bytes tells clients.
inline constexpr int64_t kMaxRequestBytes = 4 << 20;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_REQUEST_LIMIT_H_
