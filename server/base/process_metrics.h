#ifndef ROLLGAIT_SERVER_BASE_PROCESS_METRICS_H_
#define ROLLGAIT_SERVER_BASE_PROCESS_METRICS_H_

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <vector>

namespace rollgait::server {

// This process as the system sees it, under the names of the Prometheus client libraries: process_cpu_seconds_total,
// process_resident_memory_bytes, process_open_fds, process_max_fds, process_threads, process_start_time_seconds.
class ProcessMetrics : public prometheus::Collectable {
 public:
  ProcessMetrics();
  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const double start_time_s_;  // wall clock
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_PROCESS_METRICS_H_
