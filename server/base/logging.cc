#include "server/base/logging.h"

#include <spdlog/formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>

#include "server/base/log_line.h"
#include "server/base/log_writer.h"

namespace rollgait::server {
namespace {

// The fields of the event that this thread is logging; null: a plain message.
thread_local const std::initializer_list<LogField>* current_fields = nullptr;
thread_local const LogScope* innermost_scope = nullptr;

std::string Rfc3339(std::chrono::system_clock::time_point time) {
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
  const std::time_t seconds = micros / 1'000'000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char date[24], text[40];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text, sizeof text, "%s.%06dZ", date, static_cast<int>(micros % 1'000'000));
  return text;
}

std::string_view LevelName(spdlog::level::level_enum level) {
  const spdlog::string_view_t name = spdlog::level::to_string_view(level);
  return {name.data(), name.size()};
}

}  // namespace

// A line is formatted in the thread that logs it, where its fields are.
class LogFormatter : public spdlog::formatter {
 public:
  LogFormatter(std::string program, LogFormat format) : program_(std::move(program)), format_(format) {}

  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& destination) override {
    const std::string_view payload(message.payload.data(), message.payload.size());
    LogLine line(format_);
    line.AddWord("ts", Rfc3339(message.time));
    line.AddWord("level", LevelName(message.level));
    line.AddWord("program", program_);
    if (current_fields == nullptr) {
      if (format_ == LogFormat::kJson) line.AddWord("event", "message");
      line.AddWord("message", payload);
    } else {
      line.AddWord("event", payload);
      for (const LogField& field : *current_fields) line.Add(field);
    }
    for (const LogScope* scope = innermost_scope; scope != nullptr; scope = scope->outer_) {
      for (const auto& [name, text] : scope->fields_) {
        if (!text.empty()) line.Add({name, text});
      }
    }
    const std::string text = std::move(line).Take() + "\n";
    destination.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<LogFormatter>(program_, format_);
  }

 private:
  const std::string program_;
  const LogFormat format_;
};

// Hands formatted lines to the thread that writes them.
class QueueSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  QueueSink(const std::string& program, LogFormat format)
      : writer_({STDERR_FILENO, LogWriter::Options().most_bytes,
                 [program, format](int64_t lines) { return DroppedLine(program, format, lines); }}) {}

 private:
  static std::string DroppedLine(const std::string& program, LogFormat format, int64_t lines) {
    LogLine line(format);
    line.AddWord("ts", Rfc3339(std::chrono::system_clock::now()));
    line.AddWord("level", "warning");
    line.AddWord("program", program);
    line.AddWord("event", "log.dropped");
    line.Add({"lines", lines});
    return std::move(line).Take() + "\n";
  }
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    writer_.Write(std::string(text.data(), text.size()));
  }
  void flush_() override { writer_.Flush(LogWriter::kEndWait); }

  LogWriter writer_;
};

std::vector<std::string> LogFormatWishes() { return {"auto", "json", "text"}; }
std::vector<std::string> LogLevels() { return {"debug", "info", "warning", "error"}; }

LogFormat ChooseLogFormat(const std::string& wish) {
  if (wish == "json") return LogFormat::kJson;
  return wish == "text" || isatty(STDERR_FILENO) == 1 ? LogFormat::kText : LogFormat::kJson;
}

void StartLogging(const LogOptions& options) {
  auto logger =
      std::make_shared<spdlog::logger>(options.program, std::make_shared<QueueSink>(options.program, options.format));
  logger->set_formatter(std::make_unique<LogFormatter>(options.program, options.format));
  logger->set_level(spdlog::level::from_str(options.level));
  logger->flush_on(spdlog::level::critical);
  spdlog::set_default_logger(std::move(logger));
}

void LogEvent(spdlog::level::level_enum level, std::string_view event, std::initializer_list<LogField> fields) {
  spdlog::logger* const logger = spdlog::default_logger_raw();
  if (!logger->should_log(level)) return;
  current_fields = &fields;
  logger->log(level, spdlog::string_view_t(event.data(), event.size()));
  current_fields = nullptr;
}

LogScope::LogScope(const LogFields& fields) : fields_(fields), outer_(innermost_scope) { innermost_scope = this; }
LogScope::~LogScope() { innermost_scope = outer_; }

}  // namespace rollgait::server
