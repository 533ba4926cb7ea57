#include "server/store/disk_room.h"

#include <sys/statvfs.h>

namespace rollgait::server {

std::optional<int64_t> DiskRoom::FreeBytes() const {
  struct statvfs disk {};
  if (directory_.empty() || statvfs(directory_.c_str(), &disk) != 0) return std::nullopt;
  return static_cast<int64_t>(disk.f_bavail) * static_cast<int64_t>(disk.f_frsize);
}

std::optional<Error> DiskRoom::Refusal() const {
  const std::optional<int64_t> free = FreeBytes();
  if (!free || *free >= reserve_bytes_) return std::nullopt;
  const auto mib = [](int64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; };
  return Error{ErrorCode::kResourceExhausted,
               "the store's disk has " + mib(*free) + " free, and " + mib(reserve_bytes_) +
                   " are kept for solves that were accepted; try again when there is room",
               {},
               std::chrono::milliseconds(10'000)};
}

}  // namespace rollgait::server
