#include "server/base/socket_file.h"

#include <sys/stat.h>
#include <unistd.h>

namespace rollgait::server {

std::optional<SocketFile> SocketFile::At(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return std::nullopt;
  return SocketFile(path, info.st_dev, info.st_ino);
}

void SocketFile::Remove() const {
  struct stat info {};
  if (stat(path_.c_str(), &info) == 0 && info.st_dev == device_ && info.st_ino == inode_) unlink(path_.c_str());
}

}  // namespace rollgait::server
