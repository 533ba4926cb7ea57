#include "server/base/clock.h"

#include <ctime>
#include <fstream>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

timespec Now(clockid_t id) {
  timespec time{};
  ROLLGAIT_CHECK(clock_gettime(id, &time) == 0);
  return time;
}

}  // namespace

SystemClock::SystemClock() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  ROLLGAIT_CHECK(static_cast<bool>(std::getline(file, boot_id_)));
}

int64_t SystemClock::WallMicros() const {
  const timespec time = Now(CLOCK_REALTIME);
  return int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

int64_t SystemClock::BootNanos() const {
  const timespec time = Now(CLOCK_BOOTTIME);
  return int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace rollgait::server
