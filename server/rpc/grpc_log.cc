#include "server/rpc/grpc_log.h"

#include <grpc/support/log.h>
#include <spdlog/common.h>

#include <optional>
#include <string>

#include "server/base/logging.h"
#include "server/base/rate_limit.h"

namespace rollgait::server {
namespace {

// What gRPC says of a handshake that failed, anyone who connects can make it say: so many lines a second.
constexpr int64_t kLinesPerSecond = 20;

void Log(gpr_log_func_args* said) {
  static RateLimit* const lines = new RateLimit(kLinesPerSecond);  // gRPC speaks until the process ends
  const std::optional<int64_t> suppressed = lines->Take();
  if (!suppressed) return;
  const auto level = said->severity == GPR_LOG_SEVERITY_ERROR  ? spdlog::level::warn
                     : said->severity == GPR_LOG_SEVERITY_INFO ? spdlog::level::info
                                                               : spdlog::level::debug;
  const std::string file = said->file;
  LogEvent(level, "grpc.said",
           {{"text", said->message},
            {"at", file.substr(file.rfind('/') + 1)},
            {"line", said->line},
            {"suppressed", *suppressed}});
}

}  // namespace

void LogWhatGrpcSays() { gpr_set_log_function(Log); }

}  // namespace rollgait::server
