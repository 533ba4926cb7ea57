#ifndef ROLLGAIT_TESTS_SERVER_SERVICE_WAKE_BELL_H_
#define ROLLGAIT_TESTS_SERVER_SERVICE_WAKE_BELL_H_

#include <condition_variable>
#include <mutex>

namespace rollgait::server {

// Wakes the thread that reads a watch, as the hub wakes a stream. Thread-safe.
class WakeBell {
 public:
  void Ring() {
    const std::lock_guard<std::mutex> lock(mutex_);
    rung_ = true;
    woken_.notify_one();
  }
  // Sleeps until it was rung since the last time.
  void Wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    woken_.wait(lock, [this] { return rung_; });
    rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable woken_;
  bool rung_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_SERVICE_WAKE_BELL_H_
