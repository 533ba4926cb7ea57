#ifndef ROLLGAIT_CORE_OCP_COST_CONTEXT_H_
#define ROLLGAIT_CORE_OCP_COST_CONTEXT_H_

#include <functional>
#include <vector>

#include "core/math/exponential_spring.h"
#include "core/ocp/cost_traits.h"
#include "core/ocp/problem.h"

namespace rollgait {

// One actuated joint as its muscles see it. What ligaments and stretched muscles give (`passive`) costs nothing: the
// muscles pay for  m = τ − p(q), the rest of the joint's torque.
struct MuscledJoint {
  int coordinate = 0;   // index into q and v
  double strength = 1;  // N m, > 0
  double weight = 1;
  ExponentialSpring passive;  // rad -> N m
};

// What the integral of a term is made from, besides the term. The problem has everything but its costs.
struct CostContext {
  const OptimalControlProblem& problem;
  PointLayout layout;
  bool rolling_body;  // the actuated joints are the three that turn one body
  // The actuated joints with these weights; contract: each of them has one.
  std::function<std::vector<MuscledJoint>(const JointWeights&)> muscles;

  // The weights of the actuated joints, 1 where none is given.
  VectorX EffortWeights(const JointWeights& named) const;
  // The weights of all joints, 0 where none is given.
  VectorX WeightsOfAll(const JointWeights& named) const;
  // Mechanical power of a walker, W: about 0.5 J per newton of weight and metre.
  double TypicalPower() const { return 0.5 * problem.force_size(); }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COST_CONTEXT_H_
