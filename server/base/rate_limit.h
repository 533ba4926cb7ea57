#ifndef ROLLGAIT_SERVER_BASE_RATE_LIMIT_H_
#define ROLLGAIT_SERVER_BASE_RATE_LIMIT_H_

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace rollgait::server {

// Lets the first `per_second` of every second through and counts the others: for lines of the log that anybody can
// cause. Threads may share it.
class RateLimit {
 public:
  explicit RateLimit(int64_t per_second) : per_second_(per_second) {}

  // How many were held back since the last that was let through; nullopt: this one is held back too.
  std::optional<int64_t> Take() {
    const int64_t now = std::chrono::steady_clock::now().time_since_epoch() / std::chrono::seconds(1);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (now != std::exchange(second_, now)) let_through_ = 0;
    if (let_through_ >= per_second_) {
      ++held_back_;
      return std::nullopt;
    }
    ++let_through_;
    return std::exchange(held_back_, 0);
  }

 private:
  const int64_t per_second_;
  std::mutex mutex_;  // protects what follows
  int64_t second_ = 0, let_through_ = 0, held_back_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_RATE_LIMIT_H_
