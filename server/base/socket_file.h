#ifndef ROLLGAIT_SERVER_BASE_SOCKET_FILE_H_
#define ROLLGAIT_SERVER_BASE_SOCKET_FILE_H_

#include <sys/types.h>

#include <optional>
#include <string>

namespace rollgait::server {

// The file of a unix socket, for its owner to remove. A successor may have put a socket of its own there meanwhile.
class SocketFile {
 public:
  // The file that a socket has just been bound to; nullopt: there is none.
  static std::optional<SocketFile> At(const std::string& path);
  // Removes the file if it is still the same one. The socket must be open: after that the number of its inode may be
  // its successor's.
  void Remove() const;

 private:
  SocketFile(std::string path, dev_t device, ino_t inode) : path_(std::move(path)), device_(device), inode_(inode) {}

  std::string path_;
  dev_t device_;
  ino_t inode_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SOCKET_FILE_H_
