#ifndef ROLLGAIT_SERVER_RPC_ANSWER_METRICS_H_
#define ROLLGAIT_SERVER_RPC_ANSWER_METRICS_H_

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <memory>
#include <utility>
#include <vector>

#include "server/access/answer_budget.h"

namespace rollgait::server {

// What unread answers occupy at the moment that is looked at:
//   rollgait_unread_answer_bytes            of all clients, with 16 KiB for each open call
//   rollgait_answers_refused_total{limit}   calls refused for the limit of their connection, tenant or of the server
// Threads may share it.
class AnswerMetrics : public prometheus::Collectable {
 public:
  explicit AnswerMetrics(std::shared_ptr<const AnswerBudget> budget) : budget_(std::move(budget)) {}
  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const std::shared_ptr<const AnswerBudget> budget_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_ANSWER_METRICS_H_
