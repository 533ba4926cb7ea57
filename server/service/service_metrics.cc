#include "server/service/service_metrics.h"

#include <algorithm>

#include "server/base/metrics.h"

namespace rollgait::server {

std::vector<prometheus::MetricFamily> ServiceMetrics::Collect() const {
  const WatchHub::Stats streams = hub_.GetStats();
  std::vector<prometheus::MetricFamily> families = {
      GaugeNow("rollgait_solver_slots", "Solves that this server's own agent runs at once", solver_slots_),
      GaugeNow("rollgait_streams", "Open event streams", streams.readers),
      GaugeNow("rollgait_stream_lag_events", "Events that the stream furthest behind has not taken yet",
               static_cast<double>(streams.max_lag))};
  const Outcome<SolveCounts> counts = store_.Counts();
  families.push_back(GaugeNow("rollgait_store_up", "1 if the store answered", counts.ok() ? 1 : 0));
  if (!counts.ok()) return families;
  families.push_back(GaugeNow("rollgait_queue_depth", "Solves that wait", counts.value().queued));
  const int64_t oldest = counts.value().oldest_queued_us;
  const double waited_s = oldest == 0 ? 0 : 1e-6 * static_cast<double>(clock_.WallMicros() - oldest);
  families.push_back(GaugeNow("rollgait_queue_oldest_seconds",
                              "How long the oldest of the solves that wait has waited, in s", std::max(0.0, waited_s)));
  families.push_back(GaugeNow("rollgait_running", "Solves that run", counts.value().running));
  return families;
}

}  // namespace rollgait::server
