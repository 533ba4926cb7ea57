#ifndef ROLLGAIT_TESTS_FUZZ_FIELD_PATH_H_
#define ROLLGAIT_TESTS_FUZZ_FIELD_PATH_H_

#include <google/protobuf/descriptor.h>

#include <string>

namespace rollgait {

// True if the path leads to a field of the message: "model.name", "costs[0].weight",
// "limits.joint_position[\"knee_r\"].min". The last part may also be the number of a field that the message does not
// know.
inline bool NamesField(const google::protobuf::Descriptor& type, const std::string& path) {
  const size_t end = path.find_first_of(".[");
  const std::string name = path.substr(0, end);
  if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos) return end == std::string::npos;
  const google::protobuf::FieldDescriptor* field = type.FindFieldByName(name);
  if (field == nullptr) return false;
  std::string rest = end == std::string::npos ? "" : path.substr(end);
  if (!rest.empty() && rest[0] == '[') {
    const bool quoted = rest.size() > 1 && rest[1] == '"';
    const size_t close = quoted ? rest.rfind("\"]") : rest.find(']');
    if (!field->is_repeated() || close == std::string::npos || (quoted && close < 2)) return false;
    rest = rest.substr(close + (quoted ? 2 : 1));
  }
  if (rest.empty()) return true;
  if (rest[0] != '.' || field->cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_MESSAGE) return false;
  const google::protobuf::Descriptor* inner = field->message_type();
  if (field->is_map()) inner = inner->map_value()->message_type();
  return inner != nullptr && NamesField(*inner, rest.substr(1));
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_FUZZ_FIELD_PATH_H_
