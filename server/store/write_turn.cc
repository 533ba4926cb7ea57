#include "server/store/write_turn.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "server/store/sql_connection.h"

namespace rollgait::server {

WriteTurn::~WriteTurn() {
  if (fd_ >= 0) close(fd_);
}

bool WriteTurn::Take(std::chrono::steady_clock::time_point until) {
  if (fd_ < 0) fd_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (fd_ < 0) throw SqlFailure(SqlFailure::Kind::kUnavailable, "cannot open " + path_ + ": " + std::strerror(errno));
  while (flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) {
      throw SqlFailure(SqlFailure::Kind::kUnavailable, "cannot lock " + path_ + ": " + std::strerror(errno));
    }
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

void WriteTurn::Leave() noexcept { flock(fd_, LOCK_UN); }

}  // namespace rollgait::server
