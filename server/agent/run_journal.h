#ifndef ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_
#define ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/agent/spool.h"
#include "server/base/wire.pb.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// What one run leaves to the next attempt at its solve: the records that its solver sends, in the spool and, for agents
// with another spool, in the store; and what it takes up from the attempts before it. Lines of the log need a LogScope
// with the solve. One thread.
class RunJournal {
 public:
  // Where journals of a solve are besides the spool.
  enum class Elsewhere { kNowhere, kInStore };
  // solver_fingerprint: SHA-256 of the program; it reads only what it wrote itself. `spool` and `store` outlive it.
  RunJournal(const Spool& spool, SolveStore& store, Elsewhere elsewhere, const Lease& lease,
             const std::string& solver_fingerprint);

  // Takes up what earlier attempts have left of the solve that was claimed. Left alone is a journal from which an
  // attempt went on and crashed without a record of its own, if another crash would be the last.
  void TakeUp(const SolveRecord& claimed);

  // For the solver. The next attempt is to go on from there, too, until this one has come further.
  const wire::Journal& records() const { return journal_.journal(); }

  // From the solver. False: this cannot be a record of the solve.
  bool Take(wire::SolverMessage::Record record);
  // How the solver goes on.
  void Take(const wire::SolverMessage::Continuation& continuation);
  // True for iterations that an earlier attempt has reported, which the solver repeats because its last records are
  // older.
  bool HasReported(const v1::Iteration& iteration);

  // There is something to save; only when every iteration so far is in the store, so that the next attempt leaves none
  // out. A failure costs the next attempt time and is logged once.
  bool changed() const { return changed_; }
  void Save();
  // Saves, and shares if it is time. `now` never goes back.
  void Keep(std::chrono::steady_clock::time_point now);
  // Puts into the store what was saved, unless it is there; nothing if the spool is all there is. A failure is logged
  // once, and the next call tries again. Returns how long to wait before that, so that a store gets no more than
  // kBytesPerSecond of a solve.
  std::chrono::milliseconds Share();
  // The agent waits meanwhile, and the store's log keeps each. human29 at fine accuracy (2.4 MB, e2e.outliving_test)
  // goes out every 2.4 s, the largest (kMaxJournalBytes) every minute.
  static constexpr size_t kBytesPerSecond = size_t{1} << 20;
  // The least, before the first time, too: what a machine that dies takes with it. Most solves are over before.
  static constexpr std::chrono::milliseconds kSharePause{2000};
  // The solve has ended.
  void Remove() const { spool_.RemoveJournals(lease_.solve_id); }

 private:
  std::optional<KeptJournal> Newest() const;
  bool IsTooLarge(size_t more);

  const Spool& spool_;
  SolveStore& store_;
  const Elsewhere elsewhere_;
  const Lease lease_;
  wire::SpooledJournal journal_;
  size_t finished_bytes_ = 0;
  // Mesh and index of the newest iteration that the store has from earlier attempts.
  std::optional<std::pair<int, int>> reported_;
  bool changed_ = false, full_ = false, failed_ = false;
  bool to_share_ = false, share_failed_ = false;
  std::optional<std::chrono::steady_clock::time_point> share_at_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_
