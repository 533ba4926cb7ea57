#ifndef ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_
#define ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/store/solve_store.h"

namespace rollgait::server {

// Keeps a store within its limits, by a thread that looks now and then and removes in small steps, so that others may
// write in between.
class RetentionTask {
 public:
  // The store outlives it. Without any limit there is no thread.
  RetentionTask(SolveStore& store, const RetentionLimits& limits, std::chrono::milliseconds interval);
  ~RetentionTask();

 private:
  void Loop();
  void Clean();
  // False: the task is over.
  bool Pause(std::chrono::milliseconds time);

  SolveStore& store_;
  const RetentionLimits limits_;
  const std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_RETENTION_TASK_H_
