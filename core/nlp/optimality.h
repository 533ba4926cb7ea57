#ifndef ROLLGAIT_CORE_NLP_OPTIMALITY_H_
#define ROLLGAIT_CORE_NLP_OPTIMALITY_H_

#include <algorithm>
#include <cmath>

#include "core/nlp/newton_step.h"

namespace rollgait {

// How far a point is from satisfying the barrier equations for μ; with μ = 0, the optimality conditions.
struct OptimalityError {
  double primal = kInfinity;           // max |c|
  double dual = kInfinity;             // max |∇f + Aᵀ y − z_l + z_u|
  double complementarity = kInfinity;  // max |distance · z − μ|
  double scaled = kInfinity;           // E_μ of Wächter and Biegler, eq. (5)
};

// Adds up how far a point is from satisfying the equations for μ.
class OptimalitySum {
 public:
  explicit OptimalitySum(double mu) : mu_(mu) {}
  // Of every unknown that is not fixed: its part of the gradient, and its bounds. lagrangian: as below.
  void AddUnknowns(const BarrierProblem& barrier, const BarrierProblem::Point& point, const Multipliers& multipliers,
                   const VectorX& lagrangian);
  void AddGradient(double value) { dual_ = std::max(dual_, std::abs(value)); }
  void AddBound(double distance, double z);
  // primal: max |c|. y: the multipliers of all rows.
  OptimalityError With(double primal, const VectorX& y) const;

 private:
  double mu_, dual_ = 0, complementarity_ = 0, sum_z_ = 0;
  int bounds_ = 0;
};

// lagrangian: ∇f + Aᵀ y by w.
OptimalityError ComputeOptimalityError(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                                       const Multipliers& multipliers, const VectorX& lagrangian, double mu);

// Whether the optimality conditions hold to the tolerance, as Ipopt asks it with its default tolerances of the parts.
bool IsWithin(const OptimalityError& error, double tolerance);

// From ∇f to ∇f + Aᵀ y by w = (x, s), with the Jacobian that is in `kkt`. lagrangian (unknowns()): its part of x is ∇f
// before.
void AddConstraintGradients(const BarrierProblem& barrier, const KktSystem& kkt, const VectorX& y, VectorX* lagrangian);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_OPTIMALITY_H_
