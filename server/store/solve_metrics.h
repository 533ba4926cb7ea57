#ifndef ROLLGAIT_SERVER_STORE_SOLVE_METRICS_H_
#define ROLLGAIT_SERVER_STORE_SOLVE_METRICS_H_

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "server/base/metrics.h"
#include "server/store/solve_record.h"

namespace rollgait::server {

// What becomes of solves, told by the calls of one process on its store:
//   rollgait_solves_created_total{source}                queue, cache
//   rollgait_cache_hits_total                            requests answered from a stored result
//   rollgait_solve_seconds{model, termination}           from claim to stored end, one run
//   rollgait_solves_total{model, state, termination}     ends
//   rollgait_leases                                      solves that this process works on
//   rollgait_lease_lost_total                            writes refused because the lease was another's
//   rollgait_retries_total{reason}                       solves put back into the queue: crash, solver_gone,
//   agent_stopped, agent_died, lease_expired
// The termination of a run without a result is the kind of its error. Threads may share it.
class SolveMetrics {
 public:
  explicit SolveMetrics(Metrics& metrics);

  void Created(bool from_cache);
  void Claimed(const ClaimedSolve& claimed);
  void Finished(const Lease& lease, const SolveEnd& end);
  void GivenBack(const Lease& lease, GiveBackReason reason, SolveState now);
  void LeaseLost(const Lease& lease);
  void Requeued(const std::string& reason, size_t solves);

 private:
  using Clock = std::chrono::steady_clock;
  struct Run {
    std::string model;
    Clock::time_point start;
  };
  // Forgets the run. One that this process has not claimed (an end from the spool) has no model and no time.
  Run Take(const Lease& lease);
  void CountEnd(const Run& run, SolveState state, const std::string& termination);

  prometheus::Family<prometheus::Counter>&solves_, &retries_;
  prometheus::Family<prometheus::Histogram>& seconds_;
  prometheus::Counter &queued_, &from_cache_, &cache_hits_, &lease_lost_;
  prometheus::Gauge& leases_;
  BoundedLabel models_{32};
  std::mutex mutex_;                 // protects what follows
  std::map<std::string, Run> runs_;  // by id of the solve
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SOLVE_METRICS_H_
