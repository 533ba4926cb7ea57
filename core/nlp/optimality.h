#ifndef ROLLGAIT_CORE_NLP_OPTIMALITY_H_
#define ROLLGAIT_CORE_NLP_OPTIMALITY_H_

#include "core/nlp/newton_step.h"

namespace rollgait {

// How far a point is from satisfying the barrier equations for μ; with μ = 0, the optimality conditions.
struct OptimalityError {
  double primal = kInfinity;           // max |c|
  double dual = kInfinity;             // max |∇f + Aᵀ y − z_l + z_u|
  double complementarity = kInfinity;  // max |distance · z − μ|
  double scaled = kInfinity;           // E_μ of Wächter and Biegler, eq. (5)
};

// lagrangian: ∇f + Aᵀ y by w.
OptimalityError ComputeOptimalityError(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                                       const Multipliers& multipliers, const VectorX& lagrangian, double mu);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_OPTIMALITY_H_
