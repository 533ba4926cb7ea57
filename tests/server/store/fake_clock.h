#ifndef ROLLGAIT_TESTS_SERVER_STORE_FAKE_CLOCK_H_
#define ROLLGAIT_TESTS_SERVER_STORE_FAKE_CLOCK_H_

#include <atomic>
#include <chrono>
#include <string>

#include "server/base/clock.h"

namespace rollgait::server {

// A clock that moves only when told to. Set up before threads share it; Advance may be called from any thread.
class FakeClock : public Clock {
 public:
  int64_t WallMicros() const override { return wall_us_; }
  int64_t BootNanos() const override { return boot_ns_; }
  std::string BootId() const override { return boot_id_; }

  // Both times go on.
  void Advance(std::chrono::milliseconds time) {
    wall_us_ += std::chrono::microseconds(time).count();
    boot_ns_ += std::chrono::nanoseconds(time).count();
  }
  // Somebody sets the date.
  void JumpWall(std::chrono::seconds time) { wall_us_ += std::chrono::microseconds(time).count(); }
  // The machine restarts: time since boot starts again.
  void Reboot(const std::string& boot_id) {
    boot_id_ = boot_id;
    boot_ns_ = 1'000'000'000;
  }

 private:
  std::atomic<int64_t> wall_us_{1'700'000'000'000'000};
  std::atomic<int64_t> boot_ns_{3'600'000'000'000};
  std::string boot_id_ = "first-boot";
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_STORE_FAKE_CLOCK_H_
