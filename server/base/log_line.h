#ifndef ROLLGAIT_SERVER_BASE_LOG_LINE_H_
#define ROLLGAIT_SERVER_BASE_LOG_LINE_H_

#include <string>
#include <string_view>
#include <vector>

#include "server/base/logging.h"

namespace rollgait::server {

// Longer values are cut at a character and end in "…".
inline constexpr size_t kMaxLogValue = 4096;

// One line of a log, built field by field and without its end. Of fields of one name the first counts. One thread.
class LogLine {
 public:
  explicit LogLine(LogFormat format) : format_(format) {}

  // Text format: a bare word, without its name.
  void AddWord(std::string_view name, std::string_view word);
  void Add(const LogField& field);
  std::string Take() &&;

 private:
  bool Begin(std::string_view name);

  const LogFormat format_;
  std::string text_;
  std::vector<std::string_view> names_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LOG_LINE_H_
