#ifndef ROLLGAIT_SERVER_BASE_EXECUTOR_H_
#define ROLLGAIT_SERVER_BASE_EXECUTOR_H_

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rollgait::server {

// A few threads that run tasks in the order they came. For work that may block, which a gRPC reaction may not.
class Executor {
 public:
  // `capacity` bounds the tasks that TryPost lets wait.
  Executor(int threads, size_t capacity);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  // Runs what waits, then joins.
  ~Executor();

  // False: too many wait; the task was not taken.
  [[nodiscard]] bool TryPost(std::function<void()> task);
  // Always takes the task: for work that has been accepted before. After Stop it is dropped.
  void Post(std::function<void()> task);
  // Waits until nothing waits or runs, at most so long. False: there is still something.
  bool WaitIdle(std::chrono::milliseconds at_most);
  // Runs what waits, then joins. Tasks posted by tasks still run.
  void Stop();

 private:
  void Work();

  const size_t capacity_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::deque<std::function<void()>> tasks_;
  bool stopping_ = false, stopped_ = false;
  size_t active_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_EXECUTOR_H_
