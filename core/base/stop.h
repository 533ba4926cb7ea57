#ifndef ROLLGAIT_CORE_BASE_STOP_H_
#define ROLLGAIT_CORE_BASE_STOP_H_

#include <atomic>

namespace rollgait {

// Set once by another thread or a signal handler; polled by the solver at every iteration.
class StopFlag {
 public:
  void Request() { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_STOP_H_
