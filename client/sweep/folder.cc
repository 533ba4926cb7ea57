#include "client/sweep/folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "client/failure.h"

namespace rollgait::client {

void MakeFolder(const std::string& flag, const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Failure(ExitCode::kUsage, flag + " " + path + ": cannot be made a folder: " + error.message());
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw Failure(ExitCode::kUsage, flag + " " + path + ": cannot be written in: " + std::strerror(errno));
  }
}

}  // namespace rollgait::client
