#ifndef ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_
#define ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/base/iterate_files.h"
#include "server/service/solve_message.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// The events of one solve as its readers see them: the newest ones that are short in memory, all others in the store.
// Threads may share it.
class SolveFeed {
 public:
  // Events up to `last_sequence` are in the store; nothing is held in memory yet. Outlived by the store and the
  // iterates.
  SolveFeed(SolveStore& store, const IterateFiles& iterates, std::string id, int64_t last_sequence, bool terminal);

  const std::string& id() const { return id_; }
  // Reads what is new in the store into memory. True if there was something new, that the solve was deleted too. One
  // thread at a time.
  Outcome<bool> Refresh();
  // Reads the newest iterate, if there is a newer one. True if there was. One thread at a time.
  bool RefreshIterate();
  // The one that was read last, null where there is none, and its number here, from 1; 0: none.
  std::shared_ptr<const v1::Iterate> iterate() const;
  int64_t iterate_number() const { return iterate_number_; }
  // At most max_events events after `position`, from memory if they are all there. May read the store. kNotFound: the
  // solve was deleted, and all that is held was delivered. kOutOfRange: retention has removed some of them.
  Outcome<std::vector<EventPtr>> After(int64_t position, int max_events);
  // Number of the newest event known here.
  int64_t last_sequence() const;
  // True if the terminal event has a number of at most `position`.
  bool EndedBy(int64_t position) const;

 private:
  static constexpr size_t kHeld = 1024;  // events in memory
  // Bytes of one of them. A longer one (a result) is read anew by each reader, which asks for its memory first
  // (AnswerBudget).
  static constexpr size_t kLongestHeld = 64 << 10;

  Outcome<std::vector<EventPtr>> Read(int64_t position, int max_events);
  // After the store has refused what is new with kOutOfRange: retention has removed it, and readers who have not got as
  // far are refused by After. Where the store has fewer events than this feed (it is an older one), After refuses all.
  Outcome<bool> SkipRemoved(const Error& refusal);
  Outcome<EventPtr> Decode(const StoredEvent& event);

  SolveStore& store_;
  const IterateFiles& iterates_;
  const std::string id_;
  mutable std::mutex mutex_;   // protects what follows
  std::deque<EventPtr> held_;  // without gaps; the last one is the newest, unless that is too long and none is held
  int64_t last_sequence_;
  bool terminal_;
  std::optional<Error> gone_;  // what the store said when the solve was no longer there
  std::shared_ptr<const v1::Iterate> iterate_;
  std::atomic<int64_t> iterate_number_{0};
  IterateFiles::Version iterate_version_;  // of the one thread that refreshes
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SOLVE_FEED_H_
