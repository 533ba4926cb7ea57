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

// Whether the optimality conditions hold to the tolerance, as Ipopt asks it with its default tolerances of the parts.
bool IsWithin(const OptimalityError& error, double tolerance);

// From ∇f (variables()) to ∇f + Aᵀ y by w = (x, s) (unknowns()), with the Jacobian that is in `kkt`.
void AddConstraintGradients(const BarrierProblem& barrier, const KktSystem& kkt, const VectorX& y, VectorX* lagrangian);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_OPTIMALITY_H_
