#ifndef ROLLGAIT_SERVER_BASE_EXECUTOR_H_
#define ROLLGAIT_SERVER_BASE_EXECUTOR_H_

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rollgait::server {

// A few threads that run tasks. For work that may block, which a gRPC reaction may not. Tasks of one lane start in the
// order they came; lanes that wait take turns. A lane with a name has at most three quarters of the threads (while
// tasks of several lanes come a quarter, and no more than half as many as there are cores, at least one; with those
// whose tasks are Blocked a half) and half of the places to wait, so that whoever fills it leaves the rest to others.
class Executor {
 public:
  // While it exists, the task that made it does not need the processor: another one of its lane may start. Nothing in
  // threads that are no executor's, and within another one.
  class Blocked {
   public:
    Blocked();
    ~Blocked();
    Blocked(const Blocked&) = delete;
    Blocked& operator=(const Blocked&) = delete;

   private:
    Executor* const executor_;  // nullptr: nothing
  };

  // `capacity` bounds the tasks that TryPost lets wait.
  Executor(int threads, size_t capacity);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  // Runs what waits, then joins.
  ~Executor();

  // False: too many wait; the task was not taken.
  [[nodiscard]] bool TryPost(const std::string& lane, std::function<void()> task);
  [[nodiscard]] bool TryPost(std::function<void()> task) { return TryPost("", std::move(task)); }
  // Always takes the task: for work that has been accepted before. After Stop it is dropped.
  void Post(const std::string& lane, std::function<void()> task);
  void Post(std::function<void()> task) { Post("", std::move(task)); }
  // Waits until nothing waits or runs, at most so long. False: there is still something.
  bool WaitIdle(std::chrono::milliseconds at_most);
  // Runs what waits, then joins. Tasks posted by tasks still run.
  void Stop();

 private:
  struct Lane {
    std::deque<std::function<void()>> tasks;
    size_t held = 0;        // threads
    size_t blocked = 0;     // of them
    bool has_turn = false;  // it is in turns_
  };
  using Lanes = std::map<std::string, Lane>;
  // The task of this thread.
  struct Current {
    Executor* executor = nullptr;
    Lanes::iterator lane = {};
  };

  void Work();
  // These need the lock.
  void Add(const std::string& lane, std::function<void()> task);
  bool MayHaveThread(const std::string& name, const Lane& lane) const;
  // Gives the lane a turn if it has none, has tasks and may have one more thread.
  void Offer(Lanes::iterator lane);

  static thread_local Current current_;

  const size_t capacity_, thread_count_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  Lanes lanes_;  // that have tasks, waiting or running
  std::deque<Lanes::iterator> turns_;
  size_t waiting_ = 0;
  std::string newest_lane_;
  std::chrono::steady_clock::time_point lanes_differed_{};  // when a task came of another lane than the one before
  bool stopping_ = false, stopped_ = false;
  size_t active_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_EXECUTOR_H_
