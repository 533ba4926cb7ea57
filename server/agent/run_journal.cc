#include "server/agent/run_journal.h"

#include <spdlog/common.h>

#include <algorithm>

#include "server/base/journal_limits.h"
#include "server/base/logging.h"

namespace rollgait::server {
namespace {

// The newest iteration among the last events of a solve; between it and the claim are changes of state only.
std::optional<std::pair<int, int>> LastIteration(SolveStore& store, const SolveRecord& record) {
  constexpr int kLookedAt = 50;
  const int64_t after = std::max(record.trimmed_sequence, record.last_sequence - kLookedAt);
  const Outcome<EventPage> page = store.ReadEvents(record.id, after, kLookedAt);
  std::optional<std::pair<int, int>> last;
  if (!page.ok()) return last;
  for (const StoredEvent& stored : page.value().events) {
    v1::SolveEvent event;
    if (stored.kind != EventKind::kIteration || !event.ParseFromString(stored.payload)) continue;
    last = {event.iteration().mesh(), event.iteration().index()};
  }
  return last;
}

void Left(const std::string& reason) {
  LogEvent(spdlog::level::warn, "solve.journal_left", {{"reason", reason + "; the solve starts from nothing"}});
}

}  // namespace

RunJournal::RunJournal(const Spool& spool, SolveStore& store, Elsewhere elsewhere, const Lease& lease,
                       const std::string& solver_fingerprint)
    : spool_(spool), store_(store), elsewhere_(elsewhere), lease_(lease) {
  journal_.set_solve_id(lease_.solve_id);
  journal_.set_solver_fingerprint(solver_fingerprint);
}

// Of one attempt the spool's, which is saved more often.
std::optional<KeptJournal> RunJournal::Newest() const {
  std::optional<KeptJournal> newest = spool_.NewestJournal(lease_.solve_id);
  if (elsewhere_ == Elsewhere::kNowhere) return newest;
  const Outcome<std::optional<StoredJournal>> stored = store_.ReadJournal(lease_.solve_id);
  if (!stored.ok()) {
    LogEvent(spdlog::level::warn, "solve.journal_unread", {{"reason", stored.error().message}});
    return newest;
  }
  if (!stored.value() || (newest && newest->epoch >= stored.value()->epoch)) return newest;
  KeptJournal journal{stored.value()->epoch, {}};
  if (!journal.content.ParseFromString(stored.value()->content) || journal.content.solve_id() != lease_.solve_id) {
    LogEvent(spdlog::level::warn, "solve.journal_damaged", {{"path", "the store"}});
    return newest;
  }
  return journal;
}

void RunJournal::TakeUp(const SolveRecord& claimed) {
  journal_.set_crashes(claimed.crashes);
  if (claimed.attempts <= 1) return;
  std::optional<KeptJournal> kept = Newest();
  if (!kept) return;
  if (kept->content.solver_fingerprint() != journal_.solver_fingerprint()) return Left("another solver wrote it");
  // Whoever wrote it may have crashed, and nobody else.
  const bool led_no_further = claimed.crashes > kept->content.crashes() + 1;
  if (led_no_further && claimed.crashes + 1 >= kMaxCrashes) {
    return Left("an attempt that went on from it crashed without getting any further");
  }
  *journal_.mutable_journal() = std::move(*kept->content.mutable_journal());
  for (const std::string& record : records().finished()) finished_bytes_ += record.size();
  reported_ = LastIteration(store_, claimed);
}

bool RunJournal::IsTooLarge(size_t more) {
  if (finished_bytes_ + more <= kMaxJournalBytes) return false;
  if (!full_) {
    LogEvent(spdlog::level::warn, "solve.journal_full",
             {{"bytes", finished_bytes_ + more}, {"limit", kMaxJournalBytes}, {"programs", records().finished_size()}});
  }
  full_ = true;
  return true;
}

bool RunJournal::Take(wire::SolverMessage::Record record) {
  wire::Journal& journal = *journal_.mutable_journal();
  if (record.program() < 0) return false;
  // After a record that was too large there is nothing to add to.
  if (record.program() > journal.finished_size()) return true;
  while (journal.finished_size() > record.program()) {
    finished_bytes_ -= journal.finished(journal.finished_size() - 1).size();
    journal.mutable_finished()->RemoveLast();
    journal.clear_started();
    changed_ = true;
  }
  if (record.has_finished()) {
    if (IsTooLarge(record.finished().size())) return true;
    finished_bytes_ += record.finished().size();
    *journal.add_finished() = std::move(*record.mutable_finished());
    journal.clear_started();
  } else {
    if (IsTooLarge(record.started().size())) return true;
    *journal.mutable_started() = std::move(*record.mutable_started());
  }
  changed_ = true;
  return true;
}

void RunJournal::Take(const wire::SolverMessage::Continuation& continuation) {
  LogEvent(continuation.ignored().empty() ? spdlog::level::info : spdlog::level::warn, "solve.goes_on",
           {{"programs", continuation.programs()},
            {"iteration", continuation.iteration()},
            {"ignored", continuation.ignored().substr(0, 200)}});
  if (!continuation.ignored().empty()) reported_.reset();
}

bool RunJournal::HasReported(const v1::Iteration& iteration) {
  if (reported_ && std::pair(iteration.mesh(), iteration.index()) <= *reported_) return true;
  reported_.reset();
  return false;
}

void RunJournal::Save() {
  if (!changed_) return;
  changed_ = false;
  const Outcome<Done> put = spool_.PutJournal(lease_, journal_);
  if (!put.ok() && !failed_) {
    LogEvent(spdlog::level::warn, "solve.journal_failed", {{"reason", put.error().message}});
  }
  failed_ = !put.ok();
  to_share_ = elsewhere_ == Elsewhere::kInStore;
}

void RunJournal::Keep(std::chrono::steady_clock::time_point now) {
  Save();
  if (!share_at_) share_at_ = now + kSharePause;
  if (now >= *share_at_) share_at_ = now + Share();
}

std::chrono::milliseconds RunJournal::Share() {
  if (!to_share_) return kSharePause;
  const std::string content = journal_.SerializeAsString();
  const Outcome<Done> put = store_.PutJournal(lease_, content);
  if (!put.ok() && !share_failed_) {
    LogEvent(spdlog::level::warn, "solve.journal_not_shared", {{"reason", put.error().message}});
  }
  share_failed_ = to_share_ = !put.ok();
  return std::max(kSharePause, std::chrono::milliseconds(1000 * content.size() / kBytesPerSecond));
}

}  // namespace rollgait::server
