#include "server/service/watch_group.h"

#include <utility>

namespace rollgait::server {

Outcome<std::unique_ptr<EventSource>> WatchGroup::Open(WatchHub& hub, const std::vector<WatchPosition>& positions,
                                                       const std::function<void()>& wake) {
  std::unique_ptr<WatchGroup> group(new WatchGroup(hub.heartbeat_interval()));
  for (const WatchPosition& position : positions) {
    Outcome<std::unique_ptr<Watch>> watch = hub.Open(position, wake);
    if (!watch.ok()) return watch.error();
    group->watches_.push_back(std::move(watch).value());
  }
  return std::unique_ptr<EventSource>(std::move(group));
}

Outcome<WatchBatch> WatchGroup::TakeFrom(Watch& watch) {
  Outcome<WatchBatch> batch = watch.Take();
  if (!batch.ok() || batch.value().events.empty()) return batch;
  const Clock::time_point now = Clock::now();
  const bool heartbeat = batch.value().events.front()->has_heartbeat();
  if (heartbeat && now - last_taken_ < heartbeat_interval_) return WatchBatch();
  last_taken_ = now;
  return batch;
}

Outcome<WatchBatch> WatchGroup::Take() {
  for (size_t left = watches_.size(); left > 0; --left) {
    Outcome<WatchBatch> batch = TakeFrom(*watches_.front());
    if (!batch.ok()) return batch;
    std::unique_ptr<Watch> watch = std::move(watches_.front());
    watches_.pop_front();
    if (!batch.value().ended) watches_.push_back(std::move(watch));
    if (batch.value().events.empty()) continue;
    batch.value().ended = watches_.empty();
    return batch;
  }
  return WatchBatch{{}, watches_.empty()};
}

}  // namespace rollgait::server
