#include "core/ocp/costs/rate_costs.h"

#include <utility>

namespace rollgait::cost {

CostIntegral Make(const SquaredTorqueRate& term, const CostContext& context) {
  VectorX weights = context.EffortWeights(term.joint_weights);
  // Efforts change by a third of their size in a tenth of a second.
  const double rate = context.problem.effort_size() / 0.3;
  const double typical = weights.sum() * rate * rate;
  return RateCost{RateCost::Of::kEfforts, std::move(weights), typical};
}

CostIntegral Make(const SquaredForceRate&, const CostContext& context) {
  // A foot takes up the weight in a fifth of a second.
  const double rate = context.problem.force_size() / 0.2;
  return RateCost{RateCost::Of::kForces, {}, rate * rate};
}

}  // namespace rollgait::cost
