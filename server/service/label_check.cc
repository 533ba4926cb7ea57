#include "server/service/label_check.h"

#include <algorithm>

namespace rollgait::server {
namespace {

constexpr size_t kLongestKey = 32, kLongestValue = 64;

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }

bool IsKey(const std::string& key) {
  if (key.empty() || key.size() > kLongestKey || !IsLower(key[0])) return false;
  return std::all_of(key.begin(), key.end(),
                     [](char c) { return IsLower(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
}

std::string ValueFault(const std::string& value) {
  if (value.empty() || value.size() > kLongestValue) {
    return "is " + std::to_string(value.size()) + " characters long, must be from 1 to " +
           std::to_string(kLongestValue);
  }
  const auto strange = std::find_if(value.begin(), value.end(), [](char c) { return c < ' ' || c > '~'; });
  if (strange == value.end()) return "";
  return "holds the byte " + std::to_string(static_cast<unsigned char>(*strange)) +
         ", only printable ASCII characters are allowed";
}

}  // namespace

Labels ReadLabels(const google::protobuf::Map<std::string, std::string>& labels, size_t most, const std::string& prefix,
                  Violations* violations) {
  const std::string field = prefix + "labels";
  if (labels.size() > most) {
    violations->push_back(
        {field, "are " + std::to_string(labels.size()) + ", at most " + std::to_string(most) + " are allowed"});
    return {};
  }
  Labels read;
  for (const auto& [key, value] : labels) read[key] = value;
  for (const auto& [key, value] : read) {
    const std::string path = field + "[\"" + key.substr(0, 2 * kLongestKey) + "\"]";
    const std::string fault = ValueFault(value);
    if (!IsKey(key)) {
      violations->push_back({path, "is no key: a lower-case letter and up to " + std::to_string(kLongestKey - 1) +
                                       " of lower-case letters, digits, \"_\" and \"-\" make one"});
    } else if (!fault.empty()) {
      violations->push_back({path, fault});
    }
  }
  return read;
}

}  // namespace rollgait::server
