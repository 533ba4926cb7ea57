#ifndef ROLLGAIT_SERVER_CONVERT_UNKNOWN_FIELDS_H_
#define ROLLGAIT_SERVER_CONVERT_UNKNOWN_FIELDS_H_

#include <google/protobuf/message.h>

#include "core/base/result.h"

namespace rollgait::server {

// The fields of a message, at any depth, that this program does not know: a newer client asked for something that would
// be ignored. At most ten violations, each with the path of the message that holds the field and its number.
Violations FindUnknownFields(const google::protobuf::Message& message);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_UNKNOWN_FIELDS_H_
