#include "server/base/executor.h"

#include <utility>

namespace rollgait::server {

Executor::Executor(int threads, size_t capacity) : capacity_(capacity) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { Work(); });
}

Executor::~Executor() { Stop(); }

bool Executor::TryPost(std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopping_ || tasks_.size() >= capacity_) return false;
  tasks_.push_back(std::move(task));
  wake_.notify_one();
  return true;
}

void Executor::Post(std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopped_) return;
  tasks_.push_back(std::move(task));
  wake_.notify_one();
}

bool Executor::WaitIdle(std::chrono::milliseconds at_most) {
  std::unique_lock<std::mutex> lock(mutex_);
  return idle_.wait_for(lock, at_most, [this] { return tasks_.empty() && active_ == 0; });
}

void Executor::Stop() {
  std::vector<std::thread> threads;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    threads.swap(threads_);
    wake_.notify_all();
  }
  for (std::thread& thread : threads) thread.join();
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
}

void Executor::Work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return !tasks_.empty() || (stopping_ && active_ == 0); });
    if (tasks_.empty()) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    ++active_;
    lock.unlock();
    task();
    task = nullptr;  // what it holds is released here, not under the lock
    lock.lock();
    --active_;
    if (stopping_) wake_.notify_all();
    if (active_ == 0 && tasks_.empty()) idle_.notify_all();
  }
}

}  // namespace rollgait::server
