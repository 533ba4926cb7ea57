#ifndef ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_
#define ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_

#include <google/protobuf/map.h>

#include <map>
#include <optional>
#include <string>

namespace rollgait::server {

// The optional field `name` of a message as a std::optional.
#define ROLLGAIT_OPTIONAL(message, name) ((message).has_##name() ? std::optional((message).name()) : std::nullopt)

inline std::map<std::string, double> DecodeNumbers(const google::protobuf::Map<std::string, double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_FIELD_DECODING_H_
