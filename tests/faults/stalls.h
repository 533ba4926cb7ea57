#ifndef ROLLGAIT_TESTS_FAULTS_STALLS_H_
#define ROLLGAIT_TESTS_FAULTS_STALLS_H_

#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace rollgait::faults {

// When the whole machine stood still, as virtual ones do when their host takes their processors away: a thread sleeps a
// millisecond at a time and notes every wake-up that is late by more than kLate. The kernel gives each thread that is
// ready a turn much sooner than that, whatever the others do, so that no load of one server counts as a stall.
class Stalls {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kLate{100};

  Stalls();
  ~Stalls();
  Stalls(const Stalls&) = delete;
  Stalls& operator=(const Stalls&) = delete;

  // How long the machine stood still between two times, of which `to` is not in the future.
  Clock::duration Between(Clock::time_point from, Clock::time_point to) const;
  // From `from` to now without the stalls.
  Clock::duration RanSince(Clock::time_point from) const;

 private:
  struct Stall {
    Clock::time_point begin, end;
  };

  void Watch(const std::stop_token& stop);

  mutable std::mutex mutex_;  // protects what follows
  Clock::time_point awake_ = Clock::now();
  std::vector<Stall> stalls_;

  std::jthread thread_;
};

}  // namespace rollgait::faults

#endif  // ROLLGAIT_TESTS_FAULTS_STALLS_H_
