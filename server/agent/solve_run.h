#ifndef ROLLGAIT_SERVER_AGENT_SOLVE_RUN_H_
#define ROLLGAIT_SERVER_AGENT_SOLVE_RUN_H_

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "server/agent/run_end.h"
#include "server/agent/run_journal.h"
#include "server/agent/running_solver.h"
#include "server/agent/spool.h"
#include "server/base/clock.h"
#include "server/base/iterate_files.h"
#include "server/base/logging.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

using SteadyTime = std::chrono::steady_clock::time_point;

// One claimed solve, from the hand-over to a solver process until the store knows how it ended. Never blocks but for
// the store and the disk. One thread.
class SolveRun {
 public:
  // What every run of an agent shares; outlives the runs.
  struct Context {
    SolveStore& store;
    const Spool& spool;
    const IterateFiles& iterates;
    const Clock& clock;
    std::function<void(const std::string& id)> poke;   // tells rollgaitd that the solve has new events
    std::chrono::milliseconds batch{20};               // how long events wait for company
    std::chrono::milliseconds kill_after{2000};        // from the request to stop to SIGKILL
    std::chrono::milliseconds wall_grace{60'000};      // from max_wall_time_s to SIGKILL
    std::chrono::milliseconds lease = kLeaseDuration;  // renewed when a third of it is over
    // Of the iterations of a run, 140 each at most: as many as a request may ask for. A solver program that sends more
    // is not right; what is beyond is dropped.
    size_t max_event_bytes = size_t{16} << 20;
    double cpu_limit_s = 86400;
    RunJournal::Elsewhere journals = RunJournal::Elsewhere::kNowhere;
    std::string solver_fingerprint = {};  // results for keys of another solver are not reused; empty: unknown
  };

  SolveRun(const Context& context, ClaimedSolve claimed, std::unique_ptr<RunningSolver> process, SteadyTime now);

  const std::string& id() const { return lease_.solve_id; }
  const RunningSolver& process() const { return *process_; }
  // Its stream stays readable for ever then.
  bool stream_ended() const { return stream_end_.has_value(); }
  // Does what is due: reads the solver, renews the lease, kills, commits the end. Events are left to the agent, which
  // stores those of all its runs together.
  void Service(SteadyTime now);
  // Whether events have waited long enough, and those that wait; empty when there are none.
  bool events_due(SteadyTime now) const { return flush_at_ && now >= *flush_at_; }
  EventBatch Events() const {
    return state_ == State::kSolving ? EventBatch{lease_, pending_, solution_} : EventBatch{lease_, {}, {}};
  }
  // No events wait: keeps the journal, if it is time.
  void NoEvents(SteadyTime now);
  // What became of them.
  void EventsStored(const Outcome<LeaseState>& appended, SteadyTime now);
  // When Service is due again though no descriptor is ready.
  SteadyTime NextDue(SteadyTime now) const;
  // The store knows the end, or the solve is no longer ours.
  bool over() const { return state_ == State::kOver; }
  // Its solver was killed before the request arrived.
  bool never_began() const {
    const Crash* const crash = std::get_if<Crash>(&outcome_);
    return crash != nullptr && !crash->began;
  }
  // Asks the solver to stop because a client wants that.
  void Cancel();
  // Asks the solver to stop because the agent does. It keeps what it has come to, and the solve goes back to the queue.
  void Stop();
  // Kills the solver and gives the solve back to the queue; an end that waits for its commit stays in the spool.
  void GiveUp();

 private:
  enum class State { kSolving, kCommitting, kOver };

  void ReadSolver(SteadyTime now);
  void Take(const std::string& payload, SteadyTime now);
  void AddIteration(v1::Iteration iteration, SteadyTime now);
  void AddSolution(const v1::SolveResult& solution, SteadyTime now);
  void ShowIterate(v1::Iterate iterate, SteadyTime now);
  void RenewLease(SteadyTime now);
  void EnforceDeadlines(SteadyTime now);
  void ConcludeIfGone(SteadyTime now);
  void Commit(SteadyTime now);
  void AskToStop();
  void KillBy(SteadyTime deadline);
  void LoseLease(const std::string& reason);

  void PutIntoSpool();
  Outcome<SolveState> GiveBack(GiveBackReason reason, const std::string& detail);

  const Context& context_;
  Lease lease_;
  const LogFields fields_;   // of every line about this run
  const bool other_solver_;  // the key was made for another one than ours
  RunJournal journal_;
  const std::unique_ptr<RunningSolver> process_;
  State state_ = State::kSolving;

  std::optional<wire::SolverMessage> last_;  // result or error
  std::optional<FrameStatus> stream_end_;
  std::vector<StoredEvent> pending_;
  std::string solution_;       // v1::SolveResult: the newest one that is not stored yet; empty: none
  bool has_solution_ = false;  // there was one
  int64_t next_sequence_;
  bool spooled_ = false;
  int skipped_ = 0;         // iterations dropped: the store does not take any, or there were too many
  size_t event_bytes_ = 0;  // of all iterations so far
  bool sent_any_ = false;
  SteadyTime iterate_at_{};      // one before that is dropped
  bool iterate_failed_ = false;  // the log has a line about it
  bool taken_ = false;           // by the solver: the request
  bool killed_ = false;          // by us, at a deadline
  bool cancelled_ = false, stopping_ = false;
  bool out_of_time_ = false;
  bool grace_begins_ = false;  // it has been asked to stop; its time to do so counts from the next Service
  std::optional<SteadyTime> flush_at_, kill_at_;
  SteadyTime renew_at_, wall_end_, commit_at_;
  std::variant<SolveEnd, Crash> outcome_;  // while committing
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_AGENT_SOLVE_RUN_H_
