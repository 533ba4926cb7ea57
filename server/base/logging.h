#ifndef ROLLGAIT_SERVER_BASE_LOGGING_H_
#define ROLLGAIT_SERVER_BASE_LOGGING_H_

#include <spdlog/common.h>

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace rollgait::server {

// The log of a program: standard error, one line an event, as JSON or for people. Strings of others are safe to log:
// control characters, quotes and bytes that are no UTF-8 are escaped, so no value can end its line or its field.
// Lines are written by a thread of their own: who logs never waits for the reader of standard error, and of lines that
// do not fit into 4 MiB the oldest are dropped; event "log.dropped" counts them.
// Secrets are not safe to log: tokens and passwords are never given to a log. Threads may share everything here.
//
// Plain spdlog::info("...") belongs to it as event "message".

enum class LogFormat { kText, kJson };

struct LogOptions {
  std::string program;  // the field `program`
  LogFormat format = LogFormat::kText;
  std::string level = "info";  // debug, info, warning, error
};

// The values of --log-format. "auto": text where standard error is a terminal, else JSON.
std::vector<std::string> LogFormatWishes();
LogFormat ChooseLogFormat(const std::string& wish);
// The values of --log-level.
std::vector<std::string> LogLevels();

// From now on the process logs so. A critical line is waited for, for at most half a second. Before, spdlog's own
// format goes to standard output.
void StartLogging(const LogOptions& options);

// A field of a line. The name is of [a-z0-9_.] and outlives the line, as does text that is not owned.
using LogValue = std::variant<std::string_view, int64_t, double, bool>;
struct LogField {
  LogField(std::string_view field_name, std::string_view text) : name(field_name), value(text) {}
  LogField(std::string_view field_name, const char* text) : name(field_name), value(std::string_view(text)) {}
  LogField(std::string_view field_name, const std::string& text) : name(field_name), value(std::string_view(text)) {}
  LogField(std::string_view field_name, bool flag) : name(field_name), value(flag) {}
  template <typename Number>
  requires(std::is_arithmetic_v<Number> && !std::same_as<Number, bool>)
      LogField(std::string_view field_name, Number number)
      : name(field_name) {
    if constexpr (std::is_floating_point_v<Number>) {
      value = static_cast<double>(number);
    } else {
      value = static_cast<int64_t>(number);
    }
  }

  std::string_view name;
  LogValue value;
};

// One line: `event` ("solve.claimed": noun and past participle) and its fields.
void LogEvent(spdlog::level::level_enum level, std::string_view event, std::initializer_list<LogField> fields = {});

// Fields that belong to a longer piece of work: a call, a run. Empty texts are left out of lines.
using LogFields = std::vector<std::pair<std::string, std::string>>;

// While it lives, every line of this thread carries these fields too; of fields of the same name the innermost counts.
// Not movable; scopes of one thread end in the reverse order of their beginning. The fields outlive it.
class LogScope {
 public:
  explicit LogScope(const LogFields& fields);
  ~LogScope();
  LogScope(const LogScope&) = delete;
  LogScope& operator=(const LogScope&) = delete;

 private:
  friend class LogFormatter;
  const LogFields& fields_;
  const LogScope* const outer_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LOGGING_H_
