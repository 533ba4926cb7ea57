#include "server/base/settled_clock.h"

#include "server/base/logging.h"

namespace rollgait::server {

using std::chrono::duration_cast;
using std::chrono::microseconds;
using std::chrono::nanoseconds;

SettledClock::SettledClock(const Clock& clock, nanoseconds settle)
    : clock_(clock), settle_(settle), since_(clock.BootNanos()), lead_(Lead()) {}

microseconds SettledClock::Lead() const {
  return microseconds(clock_.WallMicros()) - duration_cast<microseconds>(nanoseconds(clock_.BootNanos()));
}

bool SettledClock::Look() {
  const microseconds lead = Lead(), jump = lead - lead_;
  lead_ = lead;
  if (std::chrono::abs(jump) > kJump) {
    since_ = nanoseconds(clock_.BootNanos());
    LogEvent(spdlog::level::warn, "clock.jumped",
             {{"seconds", static_cast<double>(jump.count()) * 1e-6},
              {"settles_in_s", static_cast<double>(settle_.count()) * 1e-9}});
  }
  return nanoseconds(clock_.BootNanos()) - since_ >= settle_;
}

}  // namespace rollgait::server
