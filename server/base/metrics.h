#ifndef ROLLGAIT_SERVER_BASE_METRICS_H_
#define ROLLGAIT_SERVER_BASE_METRICS_H_

#include <prometheus/collectable.h>
#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "server/base/outcome.h"

namespace rollgait::server {

// What a program counts, and where it can be read: GET /metrics in the Prometheus text format. Threads may share it.
// Counting costs nothing worth mentioning and goes on when nobody listens.
class Metrics {
 public:
  // With the metrics of the process (process_*) and rollgait_build_info{program, version, build}.
  Metrics(const std::string& program, const std::string& version, const std::string& build);

  prometheus::Registry& registry() { return *registry_; }
  // Metrics that are worked out when they are read. Held until the end; called by the threads that answer.
  void Collect(std::shared_ptr<prometheus::Collectable> collectable);

  // Serves them on "HOST:PORT" (an IPv6 host in brackets; port 0: any free one) without authentication or encryption.
  // Returns the address that was bound. kInvalidArgument: not HOST:PORT; kUnavailable: the address cannot be bound.
  Outcome<std::string> Listen(const std::string& address);

 private:
  const std::shared_ptr<prometheus::Registry> registry_;
  std::vector<std::shared_ptr<prometheus::Collectable>> collectables_;
  std::unique_ptr<prometheus::Exposer> exposer_;  // last: its threads end first
};

// Shortcuts for families of the registry.
prometheus::Family<prometheus::Counter>& CounterFamily(Metrics& metrics, const std::string& name,
                                                       const std::string& help);
prometheus::Family<prometheus::Gauge>& GaugeFamily(Metrics& metrics, const std::string& name, const std::string& help);
prometheus::Family<prometheus::Histogram>& HistogramFamily(Metrics& metrics, const std::string& name,
                                                           const std::string& help);
// One gauge that is worked out when it is read.
prometheus::MetricFamily GaugeNow(const std::string& name, const std::string& help, double value);

// Values that a label may take: the first `most` different ones it is asked about, "other" for the rest. Threads may
// share it.
class BoundedLabel {
 public:
  explicit BoundedLabel(size_t most) : most_(most) {}
  std::string Of(const std::string& value);

 private:
  const size_t most_;
  std::mutex mutex_;
  std::set<std::string> known_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_METRICS_H_
