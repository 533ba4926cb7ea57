#include "server/base/metrics.h"

#include <prometheus/client_metric.h>
#include <prometheus/metric_family.h>
#include <prometheus/metric_type.h>

#include <exception>
#include <utility>

#include "server/base/process_metrics.h"

namespace rollgait::server {
namespace {

// A request that does not come holds one of these threads for no longer than this: 32 half requests a second keep
// others out, and fewer do not. A scraper sends its request in one piece.
constexpr char kThreads[] = "32";
constexpr char kRequestTimeoutMillis[] = "1000";

}  // namespace

Metrics::Metrics(const std::string& program, const std::string& version, const std::string& build)
    : registry_(std::make_shared<prometheus::Registry>()) {
  GaugeFamily(*this, "rollgait_build_info", "Always 1; what runs is in the labels")
      .Add({{"program", program}, {"version", version}, {"build", build}})
      .Set(1);
  Collect(std::make_shared<ProcessMetrics>());
}

void Metrics::Collect(std::shared_ptr<prometheus::Collectable> collectable) {
  if (exposer_ != nullptr) exposer_->RegisterCollectable(collectable);
  collectables_.push_back(std::move(collectable));
}

Outcome<std::string> Metrics::Listen(const std::string& address) {
  const size_t colon = address.rfind(':');
  const std::string port = colon == std::string::npos ? "" : address.substr(colon + 1);
  const bool is_port = !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  if (colon == 0 || !is_port || std::stoi(port) > 65535) {
    return Error{ErrorCode::kInvalidArgument,
                 "--metrics-listen is " + address + ", must be HOST:PORT, for example 127.0.0.1:9464"};
  }
  try {
    exposer_ = std::make_unique<prometheus::Exposer>(std::vector<std::string>{
        "listening_ports", address, "num_threads", kThreads, "request_timeout_ms", kRequestTimeoutMillis});
  } catch (const std::exception&) {  // its text is empty or about its own options
    return Error{ErrorCode::kUnavailable,
                 "cannot serve metrics on " + address +
                     ": the address is in use, not of this machine, or not HOST:PORT with HOST a number"};
  }
  exposer_->RegisterCollectable(registry_);
  for (const auto& collectable : collectables_) exposer_->RegisterCollectable(collectable);
  return address.substr(0, colon) + ":" + std::to_string(exposer_->GetListeningPorts().front());
}

prometheus::Family<prometheus::Counter>& CounterFamily(Metrics& metrics, const std::string& name,
                                                       const std::string& help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(metrics.registry());
}

prometheus::Family<prometheus::Gauge>& GaugeFamily(Metrics& metrics, const std::string& name, const std::string& help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(metrics.registry());
}

prometheus::Family<prometheus::Histogram>& HistogramFamily(Metrics& metrics, const std::string& name,
                                                           const std::string& help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(metrics.registry());
}

prometheus::MetricFamily GaugeNow(const std::string& name, const std::string& help, double value) {
  prometheus::ClientMetric metric;
  metric.gauge.value = value;
  return {name, help, prometheus::MetricType::Gauge, {metric}};
}

std::string BoundedLabel::Of(const std::string& value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (known_.contains(value)) return value;
  if (known_.size() >= most_) return "other";
  known_.insert(value);
  return value;
}

}  // namespace rollgait::server
