#ifndef ROLLGAIT_SERVER_BASE_LOG_FLAGS_H_
#define ROLLGAIT_SERVER_BASE_LOG_FLAGS_H_

#include <CLI/CLI.hpp>
#include <string>

#include "server/base/logging.h"

namespace rollgait::server {

// What a program is told of its log on the command line.
struct LogFlags {
  std::string format = "auto", level = "info";

  LogOptions Of(const std::string& program) const { return {program, ChooseLogFormat(format), level}; }
};

// --log-format and --log-level. The flags outlive the app.
inline void AddLogFlags(CLI::App& app, LogFlags& flags) {
  app.add_option("--log-format", flags.format, "auto (text on a terminal, else JSON), json or text")
      ->check(CLI::IsMember(LogFormatWishes()))
      ->capture_default_str();
  app.add_option("--log-level", flags.level, "debug, info, warning or error")
      ->check(CLI::IsMember(LogLevels()))
      ->capture_default_str();
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LOG_FLAGS_H_
