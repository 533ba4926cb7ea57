#include "server/service/watch_hub.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "server/base/notify.h"

namespace rollgait::server {
namespace {

int64_t SteadyNanos() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

Error Stopping() {
  return {ErrorCode::kUnavailable,
          "the server is stopping; watch the solve again with after_sequence",
          {},
          std::chrono::milliseconds(500)};
}

void Ring(int event_fd) {
  const uint64_t one = 1;
  ROLLGAIT_CHECK(write(event_fd, &one, sizeof(one)) == sizeof(one));
}

}  // namespace

Watch::Watch(WatchHub& hub, std::shared_ptr<SolveFeed> feed, int64_t position, std::chrono::nanoseconds iterate_pause,
             std::function<void()> wake)
    : hub_(hub),
      feed_(std::move(feed)),
      wake_(std::make_shared<const std::function<void()>>(std::move(wake))),
      position_(position),
      last_taken_ns_(SteadyNanos()),
      iterate_pause_(iterate_pause) {}

Watch::~Watch() { hub_.Close(this); }

bool Watch::HeartbeatDue() const {
  return SteadyNanos() - last_taken_ns_ >= std::chrono::nanoseconds(hub_.heartbeat_interval_).count();
}

bool Watch::IterateDue() const {
  return wants_iterates() && feed_->iterate_number() > iterate_taken_ &&
         SteadyNanos() - iterate_taken_ns_ >= iterate_pause_.count();
}

// With what every event of this moment has that is not stored.
std::shared_ptr<v1::SolveEvent> Watch::NewEvent() const {
  auto event = std::make_shared<v1::SolveEvent>();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  event->mutable_time()->set_seconds(std::chrono::duration_cast<std::chrono::seconds>(now).count());
  event->set_sequence(position_);
  event->set_name(SolveName(feed_->id()));
  return event;
}

Outcome<WatchBatch> Watch::Take() {
  if (hub_.stopped_) return Stopping();
  Outcome<std::vector<EventPtr>> events = feed_->After(position_, kMaxBatch);
  if (!events.ok()) return events.error();
  WatchBatch batch{std::move(events).value(), false};
  if (!batch.events.empty()) {
    position_ = batch.events.back()->sequence();
    batch.ended = batch.events.back()->has_finished();
    last_taken_ns_ = SteadyNanos();
  }
  batch.ended = batch.ended || feed_->EndedBy(position_);
  if (!batch.ended && IterateDue()) {
    iterate_taken_ = feed_->iterate_number();
    iterate_taken_ns_ = last_taken_ns_ = SteadyNanos();
    const std::shared_ptr<v1::SolveEvent> shown = NewEvent();
    *shown->mutable_iterate() = *feed_->iterate();
    batch.events.push_back(shown);
  }
  if (batch.events.empty() && !batch.ended && HeartbeatDue()) {
    const std::shared_ptr<v1::SolveEvent> heartbeat = NewEvent();
    heartbeat->mutable_heartbeat();
    batch.events.push_back(heartbeat);
    last_taken_ns_ = SteadyNanos();
  }
  return batch;
}

WatchHub::WatchHub(SolveStore& store, HintChannel& hints, std::chrono::milliseconds heartbeat_interval,
                   IterateFiles iterates, Drive drive)
    : store_(store),
      hints_(hints),
      iterates_(std::move(iterates)),
      heartbeat_interval_(heartbeat_interval),
      event_fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  ROLLGAIT_CHECK(event_fd_ >= 0);
  if (drive == Drive::kThread) thread_ = std::thread([this] { Loop(); });
}

WatchHub::~WatchHub() {
  Stop();
  if (thread_.joinable()) thread_.join();
  close(event_fd_);
}

bool WatchHub::Entry::WantsIterates() const {
  return std::any_of(watches.begin(), watches.end(), [](const Watch* watch) { return watch->wants_iterates(); });
}

Outcome<std::unique_ptr<Watch>> WatchHub::Open(const WatchPosition& position, std::function<void()> wake) {
  if (stopped_) return Stopping();
  const std::string& id = position.id;
  const Outcome<EventPage> page = store_.ReadEvents(id, position.after_sequence, 0);
  if (!page.ok()) return page.error();
  std::unique_ptr<Watch> watch;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Entry& entry = entries_[id];
    if (entry.feed == nullptr) {
      entry.feed = std::make_shared<SolveFeed>(store_, iterates_, id, page.value().last_sequence,
                                               IsTerminal(page.value().state));
    }
    const int per_second = position.iterates_per_second;
    const std::chrono::nanoseconds pause(per_second > 0 ? 1'000'000'000 / per_second : 0);
    watch.reset(new Watch(*this, entry.feed, position.after_sequence, pause, std::move(wake)));
    entry.watches.push_back(watch.get());
    // The feed may be older than the page just read.
    changed_.push_back(id);
  }
  Ring(event_fd_);
  (*watch->wake_)();
  return watch;
}

void WatchHub::Close(Watch* watch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto entry = entries_.find(watch->feed_->id());
  std::vector<Watch*>& watches = entry->second.watches;
  watches.erase(std::find(watches.begin(), watches.end(), watch));
  if (watches.empty()) entries_.erase(entry);
}

WatchHub::Stats WatchHub::GetStats() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stats stats;
  for (const auto& [id, entry] : entries_) {
    const int64_t newest = entry.feed->last_sequence();
    stats.readers += static_cast<int>(entry.watches.size());
    for (const Watch* watch : entry.watches) stats.max_lag = std::max(stats.max_lag, newest - watch->position_);
  }
  return stats;
}

void WatchHub::Changed(const std::string& id) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (entries_.find(id) == entries_.end()) return;
    changed_.push_back(id);
  }
  Ring(event_fd_);
}

void WatchHub::Stop() {
  if (stopped_.exchange(true)) return;
  Ring(event_fd_);
  Wakes wakes;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [id, entry] : entries_) {
      for (const Watch* watch : entry.watches) wakes.push_back(watch->wake_);
    }
  }
  for (const auto& wake : wakes) (*wake)();
}

std::vector<std::string> WatchHub::ChangedIds() {
  std::vector<std::string> watched;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [id, entry] : entries_) watched.push_back(id);
  }
  if (watched.empty()) return {};
  const Outcome<std::map<std::string, int64_t>> newest = store_.LastSequences(watched);
  if (!newest.ok()) {
    spdlog::warn("looking for new events of {} solves failed: {}", watched.size(), newest.error().message);
    return {};
  }
  std::vector<std::string> changed;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [id, entry] : entries_) {
    const auto number = newest.value().find(id);
    const bool is_gone = number == newest.value().end();
    if (is_gone || number->second > entry.feed->last_sequence()) changed.push_back(id);
  }
  return changed;
}

std::vector<std::string> WatchHub::IteratedIds() {
  std::vector<std::string> iterated;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [id, entry] : entries_) {
    if (entry.WantsIterates()) iterated.push_back(id);
  }
  return iterated;
}

void WatchHub::Refresh(const std::string& id, bool read_events) {
  std::shared_ptr<SolveFeed> feed;
  bool wants_iterates = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto entry = entries_.find(id);
    if (entry == entries_.end()) return;
    feed = entry->second.feed;
    wants_iterates = entry->second.WantsIterates();
  }
  const Outcome<bool> changed = read_events ? feed->Refresh() : Outcome<bool>(false);
  if (!changed.ok()) spdlog::warn("reading new events of solves/{} failed: {}", id, changed.error().message);
  const bool has_iterate = wants_iterates && feed->RefreshIterate();
  if (!has_iterate && (!changed.ok() || !changed.value())) return;
  Wakes wakes;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto entry = entries_.find(id);
    if (entry == entries_.end()) return;
    for (const Watch* watch : entry->second.watches) wakes.push_back(watch->wake_);
  }
  // Outside the lock: a wake may hold the last reference to its reader, whose end calls Close.
  for (const auto& wake : wakes) (*wake)();
}

void WatchHub::WakeTheDue() {
  Wakes wakes;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [id, entry] : entries_) {
      for (const Watch* watch : entry.watches) {
        if (watch->HeartbeatDue() || watch->IterateDue()) wakes.push_back(watch->wake_);
      }
    }
  }
  for (const auto& wake : wakes) (*wake)();
}

void WatchHub::Loop() {
  int64_t last_poll_ns = SteadyNanos();
  while (!stopped_) {
    pollfd entries[] = {{hints_.fd(), POLLIN, 0}, {event_fd_, POLLIN, 0}};
    poll(entries, 2, kNotifyPollMillis);
    const bool look = SteadyNanos() - last_poll_ns >= int64_t{kNotifyPollMillis} * 1'000'000;
    if (look) last_poll_ns = SteadyNanos();
    Turn(look);
  }
}

void WatchHub::Turn(bool look) {
  uint64_t count = 0;
  if (read(event_fd_, &count, sizeof(count)) < 0) count = 0;  // nobody rang
  std::vector<std::string> ids = hints_.Drain();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ids.insert(ids.end(), changed_.begin(), changed_.end());
    changed_.clear();
  }
  std::vector<std::string> iterated;
  if (look) {
    const std::vector<std::string> missed = ChangedIds();
    ids.insert(ids.end(), missed.begin(), missed.end());
    iterated = IteratedIds();
    WakeTheDue();
  }
  for (const std::string& id : ids) Refresh(id, true);
  for (const std::string& id : iterated) Refresh(id, false);
}

}  // namespace rollgait::server
