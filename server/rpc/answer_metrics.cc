#include "server/rpc/answer_metrics.h"

#include "server/base/metrics.h"

namespace rollgait::server {

std::vector<prometheus::MetricFamily> AnswerMetrics::Collect() const {
  prometheus::MetricFamily refused{"rollgait_answers_refused_total",
                                   "Calls refused because unread answers reached a limit",
                                   prometheus::MetricType::Counter,
                                   {}};
  const std::array<int64_t, 3> counts = budget_->refused();
  for (size_t i = 0; i < counts.size(); ++i) {
    prometheus::ClientMetric metric;
    metric.label.push_back({"limit", AnswerBudget::kLimitNames[i]});
    metric.counter.value = static_cast<double>(counts[i]);
    refused.metric.push_back(std::move(metric));
  }
  return {GaugeNow("rollgait_unread_answer_bytes", "Bytes that answers which were not read yet occupy",
                   static_cast<double>(budget_->held())),
          std::move(refused)};
}

}  // namespace rollgait::server
