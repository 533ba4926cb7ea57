#ifndef ROLLGAIT_SERVER_BASE_FILE_LOCK_H_
#define ROLLGAIT_SERVER_BASE_FILE_LOCK_H_

#include <optional>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// An exclusive flock on a file, created if need be and never inherited by children: held until destroyed or until the
// process dies, however it dies. Movable.
class FileLock {
 public:
  // nullopt: another process (or another FileLock of this one) holds it. kUnavailable if the file cannot be opened.
  static Outcome<std::optional<FileLock>> TryAcquire(const std::string& path);
  FileLock(FileLock&& other) noexcept : fd_(other.fd_), path_(std::move(other.path_)) { other.fd_ = -1; }
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  // Removes the file, then unlocks: for lock files whose name is used once.
  void ReleaseAndRemove();

 private:
  FileLock(int fd, std::string path) : fd_(fd), path_(std::move(path)) {}

  int fd_ = -1;
  std::string path_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_FILE_LOCK_H_
