#include "server/base/executor.h"

#include <algorithm>
#include <utility>

namespace rollgait::server {
namespace {

// For so long after tasks of two lanes came one after the other, lanes are taken to share the threads.
constexpr std::chrono::seconds kShared{1};

}  // namespace

thread_local Executor::Current Executor::current_;

Executor::Blocked::Blocked() : executor_(std::exchange(current_.executor, nullptr)) {
  if (executor_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(executor_->mutex_);
  ++current_.lane->second.blocked;
  executor_->Offer(current_.lane);
}

Executor::Blocked::~Blocked() {
  if (executor_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(executor_->mutex_);
  --current_.lane->second.blocked;
  current_.executor = executor_;
}

Executor::Executor(int threads, size_t capacity) : capacity_(capacity), thread_count_(static_cast<size_t>(threads)) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { Work(); });
}

Executor::~Executor() { Stop(); }

bool Executor::MayHaveThread(const std::string& name, const Lane& lane) const {
  if (name.empty()) return lane.held < thread_count_;
  const bool shared = std::chrono::steady_clock::now() - lanes_differed_ < kShared;
  if (!shared) return lane.held < std::max<size_t>(1, thread_count_ * 3 / 4);
  const size_t most_working = std::min<size_t>(thread_count_ / 4, std::thread::hardware_concurrency() / 2);
  return lane.held - lane.blocked < std::max<size_t>(1, most_working) &&
         lane.held < std::max<size_t>(1, thread_count_ / 2);
}

void Executor::Offer(Lanes::iterator lane) {
  Lane& of = lane->second;
  if (of.has_turn || of.tasks.empty() || !MayHaveThread(lane->first, of)) return;
  of.has_turn = true;
  turns_.push_back(lane);
  wake_.notify_one();
}

void Executor::Add(const std::string& lane, std::function<void()> task) {
  if (lane != newest_lane_ && !newest_lane_.empty()) lanes_differed_ = std::chrono::steady_clock::now();
  newest_lane_ = lane;
  const Lanes::iterator place = lanes_.try_emplace(lane).first;
  place->second.tasks.push_back(std::move(task));
  ++waiting_;
  Offer(place);
}

bool Executor::TryPost(const std::string& lane, std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopping_ || waiting_ >= capacity_) return false;
  const auto known = lanes_.find(lane);
  if (!lane.empty() && known != lanes_.end() && known->second.tasks.size() >= (capacity_ + 1) / 2) return false;
  Add(lane, std::move(task));
  return true;
}

void Executor::Post(const std::string& lane, std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stopped_) return;
  Add(lane, std::move(task));
}

bool Executor::WaitIdle(std::chrono::milliseconds at_most) {
  std::unique_lock<std::mutex> lock(mutex_);
  return idle_.wait_for(lock, at_most, [this] { return waiting_ == 0 && active_ == 0; });
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
    wake_.wait(lock, [this] { return !turns_.empty() || (stopping_ && active_ == 0); });
    if (turns_.empty()) return;
    const Lanes::iterator lane = turns_.front();
    turns_.pop_front();
    lane->second.has_turn = false;
    std::function<void()> task = std::move(lane->second.tasks.front());
    lane->second.tasks.pop_front();
    --waiting_;
    ++active_;
    ++lane->second.held;
    Offer(lane);  // behind the others
    lock.unlock();
    current_ = {this, lane};
    task();
    task = nullptr;  // what it holds is released here, not under the lock
    current_ = {};
    lock.lock();
    --active_;
    --lane->second.held;
    Offer(lane);
    if (lane->second.held == 0 && lane->second.tasks.empty()) lanes_.erase(lane);
    if (stopping_) wake_.notify_all();
    if (active_ == 0 && waiting_ == 0) idle_.notify_all();
  }
}

}  // namespace rollgait::server
