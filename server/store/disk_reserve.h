#ifndef ROLLGAIT_SERVER_STORE_DISK_RESERVE_H_
#define ROLLGAIT_SERVER_STORE_DISK_RESERVE_H_

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

namespace rollgait::server {

// A file that takes room on a disk, to be given up when the disk is full and something is to be deleted: deleting needs
// room too, for SQLite's log of what changes. Any thread may call.
class DiskReserve {
 public:
  // None.
  DiskReserve() = default;
  // The file at `path` of so many bytes, made now where there is room for it.
  DiskReserve(std::string path, int64_t bytes);

  // Gives the room up. False: there is none to give.
  bool Release();
  // Takes the room again if it was given up and the disk has `spare` bytes more than that.
  void Restore(int64_t spare);

 private:
  const std::string path_;
  const int64_t bytes_ = 0;
  std::atomic<bool> held_{false};
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_DISK_RESERVE_H_
