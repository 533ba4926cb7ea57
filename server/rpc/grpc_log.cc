#include "server/rpc/grpc_log.h"

#include <grpc/support/log.h>
#include <spdlog/common.h>

#include <string>

#include "server/base/logging.h"

namespace rollgait::server {
namespace {

void Log(gpr_log_func_args* said) {
  const auto level = said->severity == GPR_LOG_SEVERITY_ERROR  ? spdlog::level::warn
                     : said->severity == GPR_LOG_SEVERITY_INFO ? spdlog::level::info
                                                               : spdlog::level::debug;
  const std::string file = said->file;
  LogEvent(level, "grpc.said",
           {{"text", said->message}, {"at", file.substr(file.rfind('/') + 1)}, {"line", said->line}});
}

}  // namespace

void LogWhatGrpcSays() { gpr_set_log_function(Log); }

}  // namespace rollgait::server
