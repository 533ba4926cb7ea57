#ifndef ROLLGAIT_SERVER_SERVICE_SERVICE_METRICS_H_
#define ROLLGAIT_SERVER_SERVICE_SERVICE_METRICS_H_

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <vector>

#include "server/base/clock.h"
#include "server/service/watch_hub.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

// The queue and the streams at the moment they are looked at:
//   rollgait_queue_depth, rollgait_running        solves that wait and that run, of all agents of the store
//   rollgait_queue_oldest_seconds                 how long the oldest of those that wait has waited
//   rollgait_solver_slots                         how many this server's own agent runs at once
//   rollgait_streams                              open event streams of this server
//   rollgait_stream_lag_events                    events that the stream furthest behind has not taken yet
//   rollgait_store_up                             1 if the store answered; else 0, and the first three are missing
// Threads may share it.
class ServiceMetrics : public prometheus::Collectable {
 public:
  // Store, hub and clock outlive it.
  ServiceMetrics(SolveStore& store, WatchHub& hub, const Clock& clock, int solver_slots)
      : store_(store), hub_(hub), clock_(clock), solver_slots_(solver_slots) {}
  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  SolveStore& store_;
  WatchHub& hub_;
  const Clock& clock_;
  const int solver_slots_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SERVICE_METRICS_H_
