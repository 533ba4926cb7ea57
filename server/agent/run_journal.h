#ifndef ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_
#define ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/agent/spool.h"
#include "server/base/wire.pb.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// What one run leaves to the next attempt at its solve: the records that its solver sends, in the spool; and what it
// takes up from the attempts before it. Lines of the log need a LogScope with the solve. One thread.
class RunJournal {
 public:
  // solver_fingerprint: SHA-256 of the program; it reads only what it wrote itself.
  RunJournal(const Spool& spool, const Lease& lease, const std::string& solver_fingerprint);

  // Takes up what earlier attempts have left of the solve that was claimed. Left alone is a journal from which the
  // attempt before went on and crashed without a record of its own, if another crash would be the last.
  void TakeUp(SolveStore& store, const SolveRecord& claimed);

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
  // The solve has ended.
  void Remove() const { spool_.RemoveJournals(lease_.solve_id); }

 private:
  bool IsTooLarge(size_t more);

  const Spool& spool_;
  const Lease lease_;
  wire::SpooledJournal journal_;
  size_t finished_bytes_ = 0;
  // Mesh and index of the newest iteration that the store has from earlier attempts.
  std::optional<std::pair<int, int>> reported_;
  bool changed_ = false, full_ = false, failed_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_RUN_JOURNAL_H_
