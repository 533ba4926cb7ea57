#ifndef ROLLGAIT_CORE_OCP_COSTS_RATE_COSTS_H_
#define ROLLGAIT_CORE_OCP_COSTS_RATE_COSTS_H_

#include "core/ocp/cost_context.h"
#include "core/ocp/cost_description.h"

namespace rollgait::cost {

// As requested: see rollgait.v1.CostTerm.
struct SquaredTorqueRate {
  JointWeights joint_weights;
};
struct SquaredForceRate {};

CostIntegral Make(const SquaredTorqueRate& term, const CostContext& context);
CostIntegral Make(const SquaredForceRate& term, const CostContext& context);

}  // namespace rollgait::cost

#endif  // ROLLGAIT_CORE_OCP_COSTS_RATE_COSTS_H_
