#ifndef ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_
#define ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "server/service/solve_message.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// The events of one solve as its readers see them: the newest ones in memory, all others in the store. Threads may
// share it.
class SolveFeed {
 public:
  // Events up to `last_sequence` are in the store; nothing is held in memory yet.
  SolveFeed(SolveStore& store, std::string id, int64_t last_sequence, bool terminal);

  const std::string& id() const { return id_; }
  // Reads what is new in the store into memory. True if there was something new. One thread at a time.
  Outcome<bool> Refresh();
  // At most max_events events after `position`, from memory if they are all there. May read the store.
  Outcome<std::vector<EventPtr>> After(int64_t position, int max_events);
  // Number of the newest event known here.
  int64_t last_sequence() const;
  // True if the terminal event has a number of at most `position`.
  bool EndedBy(int64_t position) const;

 private:
  static constexpr size_t kHeld = 1024;  // events in memory

  Outcome<std::vector<EventPtr>> Read(int64_t position, int max_events);
  Outcome<EventPtr> Decode(const StoredEvent& event);

  SolveStore& store_;
  const std::string id_;
  mutable std::mutex mutex_;  // protects what follows
  std::deque<EventPtr> held_;
  int64_t last_sequence_;
  bool terminal_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_
