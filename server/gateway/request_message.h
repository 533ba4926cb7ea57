// From a request of HTTP to the message that rollgaitd reads.
#ifndef ROLLGAIT_SERVER_GATEWAY_REQUEST_MESSAGE_H_
#define ROLLGAIT_SERVER_GATEWAY_REQUEST_MESSAGE_H_

#include <string>
#include <string_view>

#include "server/base/outcome.h"
#include "server/gateway/routes.h"

namespace rollgait::server {

inline constexpr size_t kMostQueryFields = 256;

// The request in the wire format: fields of the query (percent signs decoded) and of the body (proto3 JSON), then that
// of the path. `last_event_id` is the number in the header of that name, for a route with a cursor, and wins over the
// query. kInvalidArgument names the field: unknown, given twice, of another type, or also in the path or the body.
Outcome<std::string> MakeRequestMessage(const ResolvedRoute& route, const std::string& id, std::string_view query,
                                        std::string_view body, const std::string& last_event_id);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_REQUEST_MESSAGE_H_
