#include "server/store/disk_reserve.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <filesystem>

namespace rollgait::server {
namespace {

// False: the disk has no room for it, or does not let the file be made; then there is none.
bool Take(const std::string& path, int64_t bytes) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (fd < 0) return false;
  const bool taken = posix_fallocate(fd, 0, bytes) == 0;
  close(fd);
  if (!taken) unlink(path.c_str());
  return taken;
}

}  // namespace

DiskReserve::DiskReserve(std::string path, int64_t bytes) : path_(std::move(path)), bytes_(bytes) { Restore(0); }

bool DiskReserve::Release() { return held_.exchange(false) && unlink(path_.c_str()) == 0; }

void DiskReserve::Restore(int64_t spare) {
  if (bytes_ <= 0 || held_) return;
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  struct statvfs disk {};
  if (statvfs(folder.empty() ? "." : folder.c_str(), &disk) != 0) return;
  const int64_t free = static_cast<int64_t>(disk.f_bavail) * static_cast<int64_t>(disk.f_frsize);
  std::error_code failure;
  const bool there = std::filesystem::file_size(path_, failure) == static_cast<uintmax_t>(bytes_) && !failure;
  if (there || (free >= bytes_ + spare && Take(path_, bytes_))) held_ = true;
}

}  // namespace rollgait::server
