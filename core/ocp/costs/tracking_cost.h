#ifndef ROLLGAIT_CORE_OCP_COSTS_TRACKING_COST_H_
#define ROLLGAIT_CORE_OCP_COSTS_TRACKING_COST_H_

#include <optional>
#include <string>
#include <vector>

#include "core/ocp/cost_context.h"
#include "core/ocp/cost_description.h"

namespace rollgait::cost {

// As requested: see rollgait.v1.CostTerm.
struct Tracking {
  struct Channel {
    std::string joint;
    std::vector<double> positions;
    std::optional<double> weight;
  };
  std::vector<Channel> channels;
};

// Contract: joints are those of the problem, weights are set.
CostIntegral Make(const Tracking& term, const CostContext& context);

}  // namespace rollgait::cost

#endif  // ROLLGAIT_CORE_OCP_COSTS_TRACKING_COST_H_
