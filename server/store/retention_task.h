#ifndef ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_
#define ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/base/settled_clock.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// Keeps a store within its limits, by a thread that looks now and then and removes in small steps, so that others may
// write in between. Limits of age hold only while the wall clock is settled: a clock that jumps removes nothing.
class RetentionTask {
 public:
  // An hour: a clock that is wrong at start or is set by mistake has been noticed and corrected by then.
  static constexpr std::chrono::hours kSettle{1};

  // Store and clock outlive it. Without any limit there is no thread.
  RetentionTask(SolveStore& store, const RetentionLimits& limits, std::chrono::milliseconds interval,
                const Clock& clock, std::chrono::nanoseconds settle = kSettle);
  ~RetentionTask();

 private:
  void Loop();
  void Clean();
  // False: the task is over.
  bool Pause(std::chrono::milliseconds time);

  SolveStore& store_;
  const RetentionLimits limits_;
  const std::chrono::milliseconds interval_;
  SettledClock clock_;  // of the thread
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_
