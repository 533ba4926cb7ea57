#ifndef ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_
#define ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_

#include <google/protobuf/descriptor.h>
#include <google/protobuf/map.h>
#include <google/protobuf/message.h>

#include <map>
#include <optional>
#include <string>

#include "core/base/check.h"

namespace rollgait::server {

// The optional field `name` of a message as a std::optional.
#define ROLLGAIT_OPTIONAL(message, name) ((message).has_##name() ? std::optional((message).name()) : std::nullopt)

inline std::map<std::string, double> DecodeNumbers(const google::protobuf::Map<std::string, double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

// Contract: the message has the field. Tests hold tables that name fields and the messages together.
inline const google::protobuf::FieldDescriptor* FieldOf(const google::protobuf::Message& message, const char* name) {
  const google::protobuf::FieldDescriptor* const field = message.GetDescriptor()->FindFieldByName(name);
  ROLLGAIT_CHECK(field != nullptr);
  return field;
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_
