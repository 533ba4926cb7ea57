#ifndef ROLLGAIT_SERVER_GATEWAY_BODY_LENGTH_H_
#define ROLLGAIT_SERVER_GATEWAY_BODY_LENGTH_H_

#include <cstdint>
#include <string>

#include "server/gateway/http_exchange.h"

namespace rollgait::server {

// What the headers of a request say of its body (RFC 9112, section 6).
struct BodyLength {
  uint64_t bytes = 0;   // 0: there is none
  int status = 0;       // not 0: the request is refused with it
  std::string message;  // why it is refused
};

// A body has one length, as Content-Length, of at most `limit` bytes. Two lengths, or one that is no number, are
// refused with 400, Transfer-Encoding alone with 411, a longer body with 413.
BodyLength BodyLengthOf(const HttpRequest& head, uint64_t limit);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_BODY_LENGTH_H_
