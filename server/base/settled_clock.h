#ifndef ROLLGAIT_SERVER_BASE_SETTLED_CLOCK_H_
#define ROLLGAIT_SERVER_BASE_SETTLED_CLOCK_H_

#include <chrono>

#include "server/base/clock.h"

namespace rollgait::server {

// Whether the wall clock can be believed: it has kept pace with the boot clock since a while. A clock that was set
// wrong for a minute, or is wrong at start, is not. One thread uses it.
class SettledClock {
 public:
  // The clock outlives it. `settle`: how long the clocks must have kept pace, counted from here or from the last jump.
  SettledClock(const Clock& clock, std::chrono::nanoseconds settle);
  SettledClock(const SettledClock&) = delete;
  SettledClock& operator=(const SettledClock&) = delete;

  // Looks at both clocks. A jump is a difference of more than kJump between this look and the last.
  bool Look();

  static constexpr std::chrono::seconds kJump{10};  // a clock that is corrected gradually moves by 0.03 s a minute

 private:
  // By how much the wall clock is ahead of the boot clock.
  std::chrono::microseconds Lead() const;

  const Clock& clock_;
  const std::chrono::nanoseconds settle_;
  std::chrono::nanoseconds since_;
  std::chrono::microseconds lead_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SETTLED_CLOCK_H_
