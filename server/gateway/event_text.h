// Messages of a stream as server-sent events.
#ifndef ROLLGAIT_SERVER_GATEWAY_EVENT_TEXT_H_
#define ROLLGAIT_SERVER_GATEWAY_EVENT_TEXT_H_

#include <optional>
#include <string>

#include "server/gateway/routes.h"

namespace rollgait::server {

// "id: 7\nevent: iteration\ndata: {...}\n\n": the id of a route with a cursor is the message's `sequence`, the event is
// the field of its oneof in JSON's spelling ("message" without one), the data is the whole message as JSON. A heartbeat
// is a comment. nullopt: `wire` is not such a message.
std::optional<std::string> EventText(const ResolvedRoute& route, const std::string& wire);

// The last event of every stream that ends: "event: end", with {} or the error as data.
std::string EndText(const std::string& problem_json);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_EVENT_TEXT_H_
