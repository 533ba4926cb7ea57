#ifndef ROLLGAIT_TESTS_SERVER_STORE_SMALL_DISK_H_
#define ROLLGAIT_TESTS_SERVER_STORE_SMALL_DISK_H_

#include <fcntl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {

// A small file system in memory, mounted on a directory of its own. Needs root.
class SmallDisk {
 public:
  explicit SmallDisk(int megabytes) {
    const std::string options = "size=" + std::to_string(megabytes) + "m";
    if (mount("tmpfs", path().c_str(), "tmpfs", 0, options.c_str()) != 0) reason_ = std::strerror(errno);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (reason_.empty()) umount2(path().c_str(), MNT_DETACH);
  }
  const std::string& reason() const { return reason_; }  // why there is none; empty: there is
  const std::string& path() const { return directory_.path(); }
  // Until nothing more fits.
  void Fill() const {
    const int fd = open(Filler().c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    const std::string block(4096, 'x');
    while (write(fd, block.data(), block.size()) > 0) {
    }
    close(fd);
  }
  void Empty() const { unlink(Filler().c_str()); }

 private:
  std::string Filler() const { return path() + "/filler"; }

  const TemporaryDirectory directory_;
  std::string reason_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_STORE_SMALL_DISK_H_
