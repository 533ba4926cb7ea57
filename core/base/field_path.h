#ifndef ROLLGAIT_CORE_BASE_FIELD_PATH_H_
#define ROLLGAIT_CORE_BASE_FIELD_PATH_H_

#include <cstddef>
#include <string>

namespace rollgait {

// A client's name made fit for a message: printable ASCII without quotes, cut after 40 characters; and the same in
// quotes.
inline std::string Printable(const std::string& name) {
  constexpr size_t kMaxLength = 40;
  std::string text = name.substr(0, kMaxLength);
  for (char& c : text) {
    if (c < ' ' || c > '~' || c == '"' || c == '\\') c = '?';
  }
  if (name.size() > kMaxLength) text += "...";
  return text;
}
inline std::string Quoted(const std::string& name) { return std::string("\"").append(Printable(name)).append("\""); }

// Paths of fields in violations: "path[3]" and "path["key"]".
inline std::string Indexed(const std::string& path, size_t index) { return path + "[" + std::to_string(index) + "]"; }
inline std::string Keyed(const std::string& path, const std::string& key) { return path + "[" + Quoted(key) + "]"; }

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_FIELD_PATH_H_
