#include "tests/faults/stalls.h"

#include <algorithm>

namespace rollgait::faults {

Stalls::Stalls() : thread_([this](const std::stop_token& stop) { Watch(stop); }) {}

Stalls::~Stalls() = default;

void Stalls::Watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard<std::mutex> lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (now - awake_ > kLate) stalls_.push_back({awake_, now});
    awake_ = now;
  }
}

Stalls::Clock::duration Stalls::Between(Clock::time_point from, Clock::time_point to) const {
  const auto overlap = [from, to](const Stall& stall) {
    return std::max(Clock::duration::zero(), std::min(to, stall.end) - std::max(from, stall.begin));
  };
  const std::lock_guard<std::mutex> lock(mutex_);
  Clock::duration all{0};
  for (const Stall& stall : stalls_) all += overlap(stall);
  // The thread that asks may wake up from a stall before the one that notes it.
  if (to - awake_ > kLate) all += overlap({awake_, to});
  return all;
}

Stalls::Clock::duration Stalls::RanSince(Clock::time_point from) const {
  const Clock::time_point now = Clock::now();
  return now - from - Between(from, now);
}

}  // namespace rollgait::faults
