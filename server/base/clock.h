#ifndef ROLLGAIT_SERVER_BASE_CLOCK_H_
#define ROLLGAIT_SERVER_BASE_CLOCK_H_

#include <cstdint>
#include <string>

namespace rollgait::server {

// The two times a server needs. Implementations are safe to share between threads.
class Clock {
 public:
  virtual ~Clock() = default;
  // Microseconds since 1970 UTC. May jump; only for people to read.
  virtual int64_t WallMicros() const = 0;
  // Nanoseconds since boot, suspend included; never jumps, the same in every process of one boot.
  virtual int64_t BootNanos() const = 0;
  // Which boot BootNanos counts from.
  virtual std::string BootId() const = 0;
};

// The machine's clock.
class SystemClock : public Clock {
 public:
  // Reads the boot id once. Aborts where the kernel offers none (/proc not mounted).
  SystemClock();
  int64_t WallMicros() const override;
  int64_t BootNanos() const override;
  std::string BootId() const override { return boot_id_; }

 private:
  std::string boot_id_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_CLOCK_H_
