#ifndef ROLLGAIT_CORE_GAIT_COMBINED_COSTS_H_
#define ROLLGAIT_CORE_GAIT_COMBINED_COSTS_H_

#include <string>
#include <vector>

#include "core/gait/gait_spec.h"

namespace rollgait {

// One term of the cost, and the field of the request that a refusal of it names: "costs[2]", or "preset" for a term
// that the preset alone gives.
struct CombinedCost {
  GaitRequest::CostTerm cost;
  std::string field;
};

// The terms of the cost that a request asks for, unchecked: first those of its preset, in the preset's order, then its
// own. The request's first term of a kind that the preset has takes the place of the preset's term; what it leaves
// unset (weight, joint_weights, channels, other parameters) stays the preset's, and weight 0 switches the term off.
// Every other term is added. A request with neither a preset nor costs has squared torque of weight 1.
//   scene  the body; without it (null) a preset cannot be made up, and only the request's own terms are returned
std::vector<CombinedCost> CombineCosts(const GaitRequest& request, const Scene* scene, const Similarity& similarity);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_COMBINED_COSTS_H_
