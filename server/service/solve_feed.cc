#include "server/service/solve_feed.h"

#include <algorithm>
#include <utility>

namespace rollgait::server {

SolveFeed::SolveFeed(SolveStore& store, const IterateFiles& iterates, std::string id, int64_t last_sequence,
                     bool terminal)
    : store_(store), iterates_(iterates), id_(std::move(id)), last_sequence_(last_sequence), terminal_(terminal) {}

Outcome<EventPtr> SolveFeed::Decode(const StoredEvent& event) {
  Outcome<v1::SolveEvent> decoded = ToEvent(id_, event);
  if (!decoded.ok()) return decoded.error();
  auto message = std::make_shared<v1::SolveEvent>(std::move(decoded).value());
  if (event.kind == EventKind::kFinished) {
    const Outcome<SolveRecord> record = store_.Get(id_);
    if (!record.ok()) return record.error();
    Outcome<v1::Solve> solve = ToSolve(record.value());
    if (!solve.ok()) return solve.error();
    *message->mutable_finished() = std::move(solve).value();
  }
  return EventPtr(std::move(message));
}

Outcome<std::vector<EventPtr>> SolveFeed::Read(int64_t position, int max_events) {
  const Outcome<EventPage> page = store_.ReadEvents(id_, position, max_events);
  if (!page.ok()) return page.error();
  std::vector<EventPtr> events;
  for (const StoredEvent& stored : page.value().events) {
    Outcome<EventPtr> event = Decode(stored);
    if (!event.ok()) return event.error();
    events.push_back(std::move(event).value());
  }
  return events;
}

Outcome<bool> SolveFeed::Refresh() {
  int64_t position = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (terminal_ || gone_) return false;
    position = last_sequence_;
  }
  Outcome<std::vector<EventPtr>> read = Read(position, static_cast<int>(kHeld));
  if (!read.ok() && read.error().code == ErrorCode::kOutOfRange) return SkipRemoved(read.error());
  if (!read.ok() && read.error().code != ErrorCode::kNotFound) return read.error();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!read.ok()) {
    gone_ = read.error();
    return true;
  }
  for (EventPtr& event : read.value()) {
    last_sequence_ = event->sequence();
    terminal_ = event->has_finished();
    if (event->ByteSizeLong() > kLongestHeld) {
      held_.clear();
      continue;
    }
    held_.push_back(std::move(event));
    if (held_.size() > kHeld) held_.pop_front();
  }
  return !read.value().empty();
}

Outcome<bool> SolveFeed::SkipRemoved(const Error& refusal) {
  const Outcome<std::map<std::string, int64_t>> newest = store_.LastSequences({id_});
  if (!newest.ok()) return newest.error();
  const auto number = newest.value().find(id_);
  const int64_t last = number == newest.value().end() ? 0 : number->second;
  const Outcome<EventPage> page = store_.ReadEvents(id_, last, 0);
  if (!page.ok() && page.error().code != ErrorCode::kNotFound) return page.error();
  const std::lock_guard<std::mutex> lock(mutex_);
  held_.clear();
  if (!page.ok() || last < last_sequence_) {
    gone_ = page.ok() ? refusal : page.error();
    return true;
  }
  last_sequence_ = last;
  terminal_ = IsTerminal(page.value().state);
  return true;
}

bool SolveFeed::RefreshIterate() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (terminal_) return false;
  }
  const std::optional<std::string> bytes = iterates_.ReadNewer(id_, &iterate_version_);
  auto read = std::make_shared<v1::Iterate>();
  if (!bytes || !read->ParseFromString(*bytes)) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  iterate_ = std::move(read);
  ++iterate_number_;
  return true;
}

std::shared_ptr<const v1::Iterate> SolveFeed::iterate() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return iterate_;
}

Outcome<std::vector<EventPtr>> SolveFeed::After(int64_t position, int max_events) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (position >= last_sequence_) {
      if (gone_) return *gone_;
      return std::vector<EventPtr>();
    }
    if (!held_.empty() && held_.front()->sequence() <= position + 1) {
      const auto first = held_.begin() + (position + 1 - held_.front()->sequence());
      const auto count = std::min<int64_t>(max_events, held_.end() - first);
      return std::vector<EventPtr>(first, first + count);
    }
  }
  return Read(position, max_events);
}

int64_t SolveFeed::last_sequence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_sequence_;
}

bool SolveFeed::EndedBy(int64_t position) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return terminal_ && position >= last_sequence_;
}

}  // namespace rollgait::server
