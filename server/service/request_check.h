#ifndef ROLLGAIT_SERVER_SERVICE_REQUEST_CHECK_H_
#define ROLLGAIT_SERVER_SERVICE_REQUEST_CHECK_H_

#include <google/protobuf/message.h>

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "server/base/outcome.h"
#include "server/base/request_limit.h"

namespace rollgait::server {

// What no message of any type may hold: numbers that are not finite (but infinite limits of a Joint), enum values and
// fields that this server does not know (a request is never understood in part), more than 100 000 messages, entries of
// maps among them. The first 100 violations. `prefix` is put before every path:
// "spec." gives "spec.motion.speed_m_s".
Violations CheckWellFormed(const google::protobuf::Message& message, const std::string& prefix);

// Refuses a request of more than kMaxRequestBytes; names its largest field.
Violations CheckSize(const google::protobuf::Message& request);

// Both: what is wrong with any request, whatever its type.
Violations CheckRequest(const google::protobuf::Message& request);

// Puts `prefix` before the path of every violation.
void AddPrefix(const std::string& prefix, Violations& violations);

// How many a page of a list holds at most: `asked` is from 1 to 1000; 0: 50. Refuses others.
int CheckPageSize(int asked, Violations* violations);

// Refuses more iterates a second than a watch carries, [0, kMostIteratesPerSecond].
Violations CheckIterates(int per_second, const std::string& field);

// Refuses an id of more than 128 bytes or with other than printable ASCII characters. Empty is allowed.
Violations CheckRequestId(const std::string& request_id);

// Refuses a priority that no solve has, [kLeastPriority, kMostPriority].
Violations CheckPriority(int priority);

// kInvalidArgument with the violations and a message that holds the first one.
Error InvalidArgument(Violations violations);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_REQUEST_CHECK_H_
