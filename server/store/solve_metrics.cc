#include "server/store/solve_metrics.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {
namespace {

const prometheus::Histogram::BucketBoundaries kSolveSeconds = {0.05, 0.1, 0.25, 0.5, 1,   2.5,  5,   10,
                                                               30,   60,  120,  300, 600, 1800, 3600};

// "TIME_LIMIT" of TERMINATION_TIME_LIMIT or KIND_TIME_LIMIT as "time_limit".
std::string Label(const std::string& name, const std::string& prefix) {
  std::string label = name.starts_with(prefix) ? name.substr(prefix.size()) : "unknown";
  std::transform(label.begin(), label.end(), label.begin(), [](unsigned char c) { return std::tolower(c); });
  return label;
}

// How a run ended.
std::string TerminationOf(const SolveEnd& end) {
  v1::SolveResult result;
  v1::SolveError error;
  if (end.state == SolveState::kSucceeded && result.ParseFromString(end.result)) {
    return Label(v1::Termination_Name(result.termination()), "TERMINATION_");
  }
  if (error.ParseFromString(end.error)) return Label(v1::SolveError::Kind_Name(error.kind()), "KIND_");
  return "unknown";
}

const char* ReasonLabel(GiveBackReason reason) {
  switch (reason) {
    case GiveBackReason::kStopping:
      return "agent_stopped";
    case GiveBackReason::kNeverBegan:
      return "solver_gone";
    case GiveBackReason::kCrashed:
      return "crash";
  }
  return "unknown";
}

std::string StateLabel(SolveState state) {
  return Label(v1::SolveState_Name(static_cast<v1::SolveState>(state)), "SOLVE_STATE_");
}

}  // namespace

SolveMetrics::SolveMetrics(Metrics& metrics)
    : solves_(CounterFamily(metrics, "rollgait_solves_total", "Solves that ended in this process")),
      retries_(CounterFamily(metrics, "rollgait_retries_total", "Solves put back into the queue")),
      seconds_(HistogramFamily(metrics, "rollgait_solve_seconds", "From the claim of a solve to its stored end, in s")),
      queued_(CounterFamily(metrics, "rollgait_solves_created_total", "Solves created").Add({{"source", "queue"}})),
      from_cache_(CounterFamily(metrics, "rollgait_solves_created_total", "Solves created").Add({{"source", "cache"}})),
      cache_hits_(
          CounterFamily(metrics, "rollgait_cache_hits_total", "Requests answered from a stored result").Add({})),
      lease_lost_(
          CounterFamily(metrics, "rollgait_lease_lost_total", "Writes refused because the lease was lost").Add({})),
      leases_(GaugeFamily(metrics, "rollgait_leases", "Solves that this process works on").Add({})) {
  for (const char* reason : {"crash", "solver_gone", "agent_stopped", "agent_died", "lease_expired"})
    retries_.Add({{"reason", reason}});
}

void SolveMetrics::Created(bool from_cache) {
  (from_cache ? from_cache_ : queued_).Increment();
  if (from_cache) cache_hits_.Increment();
}

void SolveMetrics::Claimed(const ClaimedSolve& claimed) {
  v1::SolveSpec spec;
  const bool readable = spec.ParseFromString(claimed.record.spec) && !spec.model().name().empty();
  const std::string model = spec.model().has_own() ? "own" : models_.Of(readable ? spec.model().name() : "unknown");
  const std::lock_guard<std::mutex> lock(mutex_);
  runs_[claimed.lease.solve_id] = {model, Clock::now()};
  leases_.Set(static_cast<double>(runs_.size()));
}

SolveMetrics::Run SolveMetrics::Take(const Lease& lease) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = runs_.find(lease.solve_id);
  if (found == runs_.end()) return {"unknown", Clock::time_point{}};
  Run run = std::move(found->second);
  runs_.erase(found);
  leases_.Set(static_cast<double>(runs_.size()));
  return run;
}

void SolveMetrics::CountEnd(const Run& run, SolveState state, const std::string& termination) {
  solves_.Add({{"model", run.model}, {"state", StateLabel(state)}, {"termination", termination}}).Increment();
  if (run.start == Clock::time_point{}) return;
  const std::chrono::duration<double> duration = Clock::now() - run.start;
  seconds_.Add({{"model", run.model}, {"termination", termination}}, kSolveSeconds).Observe(duration.count());
}

void SolveMetrics::Finished(const Lease& lease, const SolveEnd& end) {
  CountEnd(Take(lease), end.state, TerminationOf(end));
}

void SolveMetrics::GivenBack(const Lease& lease, GiveBackReason reason, SolveState now) {
  const Run run = Take(lease);
  if (now == SolveState::kQueued) {
    Requeued(ReasonLabel(reason), 1);
  } else {
    CountEnd(run, now, now == SolveState::kCancelled ? "cancelled" : "crash");
  }
}

void SolveMetrics::LeaseLost(const Lease& lease) {
  Take(lease);
  lease_lost_.Increment();
}

void SolveMetrics::Requeued(const std::string& reason, size_t solves) {
  if (solves > 0) retries_.Add({{"reason", reason}}).Increment(static_cast<double>(solves));
}

}  // namespace rollgait::server
