#ifndef ROLLGAIT_SERVER_SERVICE_WATCH_GROUP_H_
#define ROLLGAIT_SERVER_SERVICE_WATCH_GROUP_H_

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "server/service/watch_hub.h"

namespace rollgait::server {

// One reader's places in the events of several solves. What it hands out at a time is of one solve, so that it holds no
// more than a Watch does; those with news take turns, and one that has ended is let go. A heartbeat, of any of them,
// comes if nothing was taken for the heartbeat interval, at most twice as late. Destroy it before the hub.
class WatchGroup : public EventSource {
 public:
  // As WatchHub::Open for every position; the first error is the answer.
  static Outcome<std::unique_ptr<EventSource>> Open(WatchHub& hub, const std::vector<WatchPosition>& positions,
                                                    const std::function<void()>& wake);

  // As Watch::Take; ended when the last solve has.
  Outcome<WatchBatch> Take() override;

 private:
  using Clock = std::chrono::steady_clock;
  explicit WatchGroup(std::chrono::milliseconds heartbeat_interval) : heartbeat_interval_(heartbeat_interval) {}
  // The same without a heartbeat that is not needed.
  Outcome<WatchBatch> TakeFrom(Watch& watch);

  const std::chrono::milliseconds heartbeat_interval_;
  std::deque<std::unique_ptr<Watch>> watches_;  // the first one's turn comes next
  Clock::time_point last_taken_ = Clock::now();
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_WATCH_GROUP_H_
