#include "core/ocp/cost_context.h"

namespace rollgait {

VectorX CostContext::EffortWeights(const JointWeights& named) const {
  const Model& model = problem.model;
  VectorX weights = VectorX::Ones(static_cast<int>(model.actuated().size()));
  for (int j = 0; j < weights.size(); ++j) {
    const auto it = named.find(model.joint(model.actuated()[j]).name);
    if (it != named.end()) weights(j) = it->second;
  }
  return weights;
}

VectorX CostContext::WeightsOfAll(const JointWeights& named) const {
  VectorX weights = VectorX::Zero(problem.model.size());
  for (const auto& [name, weight] : named) weights(problem.model.Find(name)) = weight;
  return weights;
}

}  // namespace rollgait
