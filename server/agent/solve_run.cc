#include "server/agent/solve_run.h"

#include <google/protobuf/util/time_util.h>
#include <signal.h>
#include <spdlog/common.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/base/cancel_signal.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRetry{500};       // after a store that could not take something
constexpr milliseconds kReapTick{1};      // between looks for a child whose stream has ended
constexpr size_t kMaxPending = 5000;      // events held for a store that takes none
constexpr double kDefaultWallTime = 600;  // s, of SolverLimits
constexpr double kMaxWallTime = 86400;

milliseconds WallTime(const v1::SolveSpec& spec) {
  double seconds =
      spec.solver_limits().has_max_wall_time_s() ? spec.solver_limits().max_wall_time_s() : kDefaultWallTime;
  if (!(seconds >= 0)) seconds = 0;  // NaN too; the solver refuses it
  return milliseconds(std::llround(1000 * std::min(seconds, kMaxWallTime)));
}

// What an event tells of a solution: of its last mesh, and of its verdict.
v1::Intermediate Describe(const v1::SolveResult& solution) {
  v1::Intermediate intermediate;
  intermediate.set_verdict(solution.accuracy().verdict());
  intermediate.set_objective(solution.objective());
  intermediate.set_elapsed_s(solution.wall_time_s());
  if (solution.has_errors()) *intermediate.mutable_errors() = solution.errors();
  const auto own = std::find_if(solution.meshes().rbegin(), solution.meshes().rend(),
                                [](const v1::MeshStatistics& mesh) { return !mesh.for_errors(); });
  if (own == solution.meshes().rend()) return intermediate;
  *intermediate.mutable_intervals() = own->intervals();
  intermediate.set_smoothing_w(own->smoothing_w());
  intermediate.set_kkt_error(own->kkt_error());
  return intermediate;
}

void Warn(const char* event, const std::string& reason) { LogEvent(spdlog::level::warn, event, {{"reason", reason}}); }

}  // namespace

SolveRun::SolveRun(const Context& context, ClaimedSolve claimed, std::unique_ptr<RunningSolver> process, SteadyTime now)
    : context_(context),
      lease_(std::move(claimed.lease)),
      fields_{
          {"solve", lease_.solve_id}, {"traceparent", claimed.record.traceparent}, {"tenant", claimed.record.tenant}},
      other_solver_(!context.solver_fingerprint.empty() && !claimed.record.solver_fingerprint.empty() &&
                    claimed.record.solver_fingerprint != context.solver_fingerprint),
      journal_(context.spool, context.store, context.journals, lease_, context.solver_fingerprint),
      process_(std::move(process)),
      next_sequence_(claimed.record.last_sequence + 1) {
  renew_at_ = now + context_.lease / 3;
  v1::SolveSpec spec;  // one that cannot be read is the solver's to refuse
  if (!spec.ParseFromString(claimed.record.spec)) spec.Clear();
  wall_end_ = now + WallTime(spec) + context_.wall_grace;
  process_->Send(claimed.record.spec);
  if (!spec.warm_start().empty()) process_->Send(claimed.warm_start);
  const LogScope scope(fields_);
  journal_.TakeUp(claimed.record);
  process_->Send(journal_.records().SerializeAsString());
  LogEvent(spdlog::level::info, "solve.claimed", {{"attempt", claimed.record.attempts}, {"pid", process_->pid()}});
  if (claimed.record.cancel_requested) Cancel();
}

void SolveRun::Service(SteadyTime now) {
  const LogScope scope(fields_);
  if (state_ == State::kSolving) {
    process_->Write();
    process_->ReadOutput();
    ReadSolver(now);
    EnforceDeadlines(now);
  }
  if (state_ != State::kOver && now >= renew_at_) RenewLease(now);
  if (state_ == State::kSolving) ConcludeIfGone(now);
  if (state_ == State::kCommitting && now >= commit_at_) Commit(now);
}

SteadyTime SolveRun::NextDue(SteadyTime now) const {
  SteadyTime due = renew_at_;
  if (state_ == State::kCommitting) return std::min(due, commit_at_);
  due = std::min(due, wall_end_);
  if (flush_at_) due = std::min(due, *flush_at_);
  if (kill_at_) due = std::min(due, *kill_at_);
  if (grace_begins_) due = std::min(due, now);
  if (stream_end_) due = std::min(due, now + kReapTick);
  return due;
}

void SolveRun::Cancel() {
  if (!cancelled_) AskToStop();
  cancelled_ = cancelled_ || state_ == State::kSolving;
}

void SolveRun::Stop() {
  stopping_ = true;
  AskToStop();
}

void SolveRun::AskToStop() {
  if (state_ != State::kSolving) return;
  process_->Kill(kCancelSignal);
  grace_begins_ = true;
}

void SolveRun::GiveUp() {
  const LogScope scope(fields_);
  process_->Kill(SIGKILL);
  if (state_ == State::kOver) return;
  if (state_ == State::kCommitting) {
    Commit(SteadyTime{});
    return;
  }
  state_ = State::kOver;
  context_.iterates.Remove(id());
  const Outcome<SolveState> given = GiveBack(GiveBackReason::kStopping, "its agent stops");
  if (!given.ok()) Warn("solve.give_back_failed", given.error().message);
  context_.poke(id());
}

void SolveRun::KillBy(SteadyTime deadline) { kill_at_ = kill_at_ ? std::min(*kill_at_, deadline) : deadline; }

void SolveRun::ReadSolver(SteadyTime now) {
  if (stream_end_) return;
  std::vector<std::string> payloads;
  const FrameStatus status = process_->Receive(&payloads);
  for (const std::string& payload : payloads) Take(payload, now);
  if (status != FrameStatus::kNeedMore && !stream_end_) stream_end_ = status;
  if (!stream_end_) return;
  // A process that spoilt its stream is of no use any more. One that closed it, kError if it had not read all, ends by
  // itself in an instant.
  const bool is_closed = *stream_end_ == FrameStatus::kEnd || *stream_end_ == FrameStatus::kError;
  KillBy(is_closed ? now + context_.kill_after : now);
}

void SolveRun::Take(const std::string& payload, SteadyTime now) {
  wire::SolverMessage message;
  if (!message.ParseFromString(payload) || message.message_case() == wire::SolverMessage::MESSAGE_NOT_SET) {
    stream_end_ = FrameStatus::kGarbage;
    return;
  }
  if (message.has_ready()) return;
  taken_ = true;
  if (message.has_taken()) return;
  if (message.has_continuation()) return journal_.Take(message.continuation());
  if (message.has_record()) {
    if (!journal_.Take(std::move(*message.mutable_record()))) stream_end_ = FrameStatus::kGarbage;
    if (!flush_at_) flush_at_ = now + context_.batch;
    return;
  }
  if (message.has_iteration()) {
    AddIteration(std::move(*message.mutable_iteration()), now);
    return;
  }
  if (message.has_intermediate()) return AddSolution(message.intermediate(), now);
  if (message.has_iterate()) return ShowIterate(std::move(*message.mutable_iterate()), now);
  last_ = std::move(message);
  KillBy(now + context_.kill_after);  // nothing is to follow but its end
}

void SolveRun::AddIteration(v1::Iteration iteration, SteadyTime now) {
  if (journal_.HasReported(iteration)) return;
  iteration.DiscardUnknownFields();  // of any length
  if (event_bytes_ > context_.max_event_bytes) {
    ++skipped_;
    return;
  }
  if (pending_.size() >= kMaxPending) {
    pending_.erase(pending_.begin());
    ++skipped_;
  }
  v1::SolveEvent event;
  *event.mutable_time() = google::protobuf::util::TimeUtil::MicrosecondsToTimestamp(context_.clock.WallMicros());
  event.set_skipped_count(std::exchange(skipped_, 0));
  *event.mutable_iteration() = std::move(iteration);
  pending_.push_back({next_sequence_++, EventKind::kIteration, event.SerializeAsString()});
  event_bytes_ += pending_.back().payload.size();
  if (!flush_at_) flush_at_ = sent_any_ ? now + context_.batch : now;
  sent_any_ = true;
}

void SolveRun::AddSolution(const v1::SolveResult& solution, SteadyTime now) {
  if (event_bytes_ > context_.max_event_bytes) return;
  has_solution_ = true;
  v1::SolveEvent event;
  *event.mutable_time() = google::protobuf::util::TimeUtil::MicrosecondsToTimestamp(context_.clock.WallMicros());
  *event.mutable_intermediate() = Describe(solution);
  event.DiscardUnknownFields();
  solution_ = solution.SerializeAsString();
  pending_.push_back({next_sequence_++, EventKind::kIntermediate, event.SerializeAsString()});
  event_bytes_ += pending_.back().payload.size();
  if (!flush_at_) flush_at_ = now + context_.batch;
}

// A solver that sends them sooner than it may fills no disk.
void SolveRun::ShowIterate(v1::Iterate iterate, SteadyTime now) {
  if (now < iterate_at_) return;
  iterate_at_ = now + kIteratePause / 2;  // what leaves the solver at its pace may arrive closer together
  iterate.DiscardUnknownFields();
  const Outcome<Done> put = context_.iterates.Put(id(), iterate.SerializeAsString());
  if (put.ok() || std::exchange(iterate_failed_, true)) return;
  Warn("solve.iterates_not_shown", put.error().message);
}

void SolveRun::NoEvents(SteadyTime now) {
  if (!events_due(now) || state_ != State::kSolving) return;
  const LogScope scope(fields_);
  flush_at_.reset();
  journal_.Keep(now);
}

void SolveRun::EventsStored(const Outcome<LeaseState>& appended, SteadyTime now) {
  const LogScope scope(fields_);
  flush_at_.reset();
  if (!appended.ok() && appended.error().code == ErrorCode::kLeaseLost) return LoseLease(appended.error().message);
  if (!appended.ok()) {
    LogEvent(spdlog::level::warn, "solve.events_wait",
             {{"events", pending_.size()}, {"reason", appended.error().message}});
    flush_at_ = now + kRetry;
    return;
  }
  pending_.clear();
  solution_.clear();
  next_sequence_ = appended.value().last_sequence + 1;
  journal_.Keep(now);
  context_.poke(id());
  if (appended.value().cancel_requested) Cancel();
}

void SolveRun::RenewLease(SteadyTime now) {
  const Outcome<LeaseState> renewed = context_.store.RenewLease(lease_, context_.lease);
  if (!renewed.ok() && renewed.error().code == ErrorCode::kLeaseLost) return LoseLease(renewed.error().message);
  if (!renewed.ok()) {
    Warn("lease.renewal_failed", renewed.error().message);
    renew_at_ = now + kRetry;
    return;
  }
  renew_at_ = now + context_.lease / 3;
  if (renewed.value().cancel_requested) Cancel();
}

void SolveRun::LoseLease(const std::string& reason) {
  Warn("lease.lost", reason);
  process_->Kill(SIGKILL);
  if (state_ == State::kCommitting) context_.spool.Remove(lease_);
  context_.iterates.Remove(id());
  state_ = State::kOver;
}

void SolveRun::EnforceDeadlines(SteadyTime now) {
  // The signal may have been sent long after the time of its turn: the store may have answered slowly before.
  if (grace_begins_) KillBy(now + context_.kill_after);
  grace_begins_ = false;
  if (now >= wall_end_ && !kill_at_) {
    out_of_time_ = true;
    kill_at_ = now;
  }
  if (kill_at_ && now >= *kill_at_) {
    process_->Kill(SIGKILL);
    killed_ = true;
    kill_at_ = now + kRetry;  // until it is gone
  }
}

void SolveRun::ConcludeIfGone(SteadyTime now) {
  if (!stream_end_) return;
  const std::optional<ProcessEnd> end = process_->Reap();
  if (!end) return;
  process_->ReadOutput();
  RunFacts facts;
  facts.last = std::move(last_);
  facts.process = *end;
  facts.stream = *stream_end_;
  facts.cancelled = cancelled_;
  facts.has_solution = has_solution_;
  facts.out_of_time = out_of_time_;
  facts.taken = taken_ || killed_;
  facts.cpu_limit_s = context_.cpu_limit_s;
  facts.output = process_->LastOutput();
  context_.iterates.Remove(id());
  outcome_ = JudgeRun(std::move(facts));
  if (SolveEnd* solve_end = std::get_if<SolveEnd>(&outcome_)) {
    if (other_solver_) solve_end->reusable = false;
    if (solve_end->result.empty()) solve_end->result = std::move(solution_);
    PutIntoSpool();
  }
  flush_at_.reset();
  state_ = State::kCommitting;
  commit_at_ = now;
}

// A failure is tried again before every commit, which may succeed though.
void SolveRun::PutIntoSpool() {
  const Outcome<Done> put = context_.spool.Put({lease_, pending_, std::get<SolveEnd>(outcome_)});
  spooled_ = put.ok();
  if (!spooled_) Warn("solve.spool_failed", put.error().message);
}

// With what the solver has come to, as far as the store takes the iterations that led there.
Outcome<SolveState> SolveRun::GiveBack(GiveBackReason reason, const std::string& detail) {
  if (!pending_.empty()) {
    const Outcome<LeaseState> appended = context_.store.AppendEvents(lease_, pending_);
    if (!appended.ok()) return appended.error();
    pending_.clear();
  }
  journal_.Save();
  journal_.Share();
  Outcome<SolveState> given = context_.store.GiveBack(lease_, reason, detail);
  if (given.ok() && IsTerminal(given.value())) journal_.Remove();
  return given;
}

void SolveRun::Commit(SteadyTime now) {
  std::optional<Error> failure;
  if (const Crash* crash = std::get_if<Crash>(&outcome_)) {
    if (!stopping_) Warn("solver.died", crash->detail);
    const GiveBackReason reason = crash->began ? GiveBackReason::kCrashed : GiveBackReason::kNeverBegan;
    const Outcome<SolveState> given =
        stopping_ ? GiveBack(GiveBackReason::kStopping, "its agent stops") : GiveBack(reason, crash->detail);
    if (!given.ok()) failure = given.error();
  } else {
    if (!spooled_) PutIntoSpool();
    const Outcome<Done> finished = context_.store.Finish(lease_, pending_, std::get<SolveEnd>(outcome_));
    if (!finished.ok()) failure = finished.error();
  }
  if (failure && failure->code == ErrorCode::kLeaseLost) return LoseLease(failure->message);
  if (failure) {
    LogEvent(spdlog::level::err, "solve.end_waits", {{"reason", failure->message}});
    commit_at_ = now + kRetry;
    return;
  }
  if (std::holds_alternative<SolveEnd>(outcome_)) journal_.Remove();
  context_.spool.Remove(lease_);
  state_ = State::kOver;
  LogEvent(spdlog::level::info, std::holds_alternative<Crash>(outcome_) ? "solve.given_back" : "solve.ended");
  context_.poke(id());
}

}  // namespace rollgait::server
