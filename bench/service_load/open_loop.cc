#include "bench/service_load/open_loop.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>

namespace rollgait::load {
namespace {

using Clock = std::chrono::steady_clock;

std::chrono::nanoseconds Seconds(double seconds) {
  return std::chrono::nanoseconds(static_cast<int64_t>(seconds * 1e9));
}

// Answers as they come.
class Tally {
 public:
  void Answered(Clock::time_point due, grpc::StatusCode code, bool counts) {
    const Clock::time_point now = Clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (counts) by_code_[code].Add(now - due);
    --open_;
    if (open_ == 0) none_open_.notify_all();
  }
  void Sent() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++open_;
  }
  int64_t open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return open_;
  }
  std::map<grpc::StatusCode, Latencies> WaitForAll() {
    std::unique_lock<std::mutex> lock(mutex_);
    none_open_.wait(lock, [this] { return open_ == 0; });
    return std::move(by_code_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable none_open_;
  std::map<grpc::StatusCode, Latencies> by_code_;
  int64_t open_ = 0;
};

}  // namespace

int64_t OpenLoopResult::Count(grpc::StatusCode code) const {
  const auto found = by_code.find(code);
  return found == by_code.end() ? 0 : found->second.count();
}

double OpenLoopResult::Rate(grpc::StatusCode code) const {
  return seconds > 0 ? static_cast<double>(Count(code)) / seconds : 0;
}

OpenLoopResult RunOpenLoop(const OpenLoopOptions& options, const Send& send) {
  std::mt19937_64 random(options.seed);
  std::exponential_distribution<double> gap(options.rate);
  Tally tally;
  OpenLoopResult result;
  const Clock::time_point start = Clock::now();
  const Clock::time_point counted_from = start + Seconds(options.warm_up);
  const Clock::time_point end = counted_from + Seconds(options.seconds);
  Clock::time_point due = start;
  for (int64_t number = 0;; ++number) {
    due += Seconds(gap(random));
    if (due >= end) break;
    std::this_thread::sleep_until(due);
    const bool counts = due >= counted_from;
    if (counts) {
      ++result.sent;
      result.lag.Add(Clock::now() - due);
    }
    tally.Sent();
    send(number, [&tally, due, counts](grpc::StatusCode code) { tally.Answered(due, code, counts); });
    if (number % 64 == 0 && tally.open() > options.most_open) {
      result.gave_up = true;
      break;
    }
  }
  result.seconds = std::chrono::duration<double>(std::min(due, end) - counted_from).count();
  result.by_code = tally.WaitForAll();
  return result;
}

std::string CodeName(grpc::StatusCode code) {
  static constexpr const char* kNames[] = {
      "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
      "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
      "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
      "DATA_LOSS", "UNAUTHENTICATED"};
  const auto number = static_cast<size_t>(code);
  return number < std::size(kNames) ? kNames[number] : "code " + std::to_string(code);
}

std::string CodesText(const OpenLoopResult& result) {
  std::string text;
  for (const auto& [code, latencies] : result.by_code) {
    text += (text.empty() ? "" : ", ") + CodeName(code) + " " + std::to_string(latencies.count());
  }
  return text.empty() ? "no answer" : text;
}

}  // namespace rollgait::load
