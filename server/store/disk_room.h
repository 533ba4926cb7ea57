#ifndef ROLLGAIT_SERVER_STORE_DISK_ROOM_H_
#define ROLLGAIT_SERVER_STORE_DISK_ROOM_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Room that is kept on a disk for the ends of solves that were accepted: new ones are refused while less is free.
// Immutable.
class DiskRoom {
 public:
  // Of a disk that is none of ours: nothing is refused.
  DiskRoom() = default;
  DiskRoom(std::string directory, int64_t reserve_bytes)
      : directory_(std::move(directory)), reserve_bytes_(reserve_bytes) {}

  // kResourceExhausted with what is free; nullopt: there is room, or the disk does not say.
  std::optional<Error> Refusal() const;
  // What may still be written there without root, bytes; nullopt: no disk of ours, or it does not say.
  std::optional<int64_t> FreeBytes() const;
  int64_t reserve_bytes() const { return reserve_bytes_; }

 private:
  std::string directory_;
  int64_t reserve_bytes_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_DISK_ROOM_H_
