#ifndef ROLLGAIT_CORE_NLP_NEWTON_STEP_H_
#define ROLLGAIT_CORE_NLP_NEWTON_STEP_H_

#include "core/nlp/barrier_problem.h"
#include "core/nlp/kkt_system.h"
#include "core/nlp/nlp_options.h"

namespace rollgait {

// Multipliers of the rows and of the bounds of w; zero where there is no bound.
struct Multipliers {
  VectorX y;             // rows()
  VectorX lower, upper;  // unknowns()
};

// A step in everything.
struct NewtonStep {
  VectorX w;
  Multipliers multipliers;
};

// The Newton step of the primal-dual barrier equations, with the Hessian shifted until the step descends (inertia
// correction of Wächter and Biegler, section 3.1).
class NewtonSystem {
 public:
  // Of the options: step_residual and first_shift.
  NewtonSystem(BarrierProblem& barrier, const NlpOptions& options);

  KktSystem& kkt() { return kkt_; }
  // δ_w of the last factorisation.
  double regularization() const { return shift_; }

  // What it has learnt from earlier systems, from which it can go on.
  struct Memory {
    double last_shift = 0, threshold = 0;
    int zero_failures = 0, skipped = 0;
  };
  Memory memory() const { return {last_shift_, kkt_.threshold(), zero_failures_, skipped_}; }
  void Restore(const Memory& memory);

  // Of a restoration phase, until it is called with null: further curvature of the variables (variables(), ≥ 0) and
  // further compliance of the rows (rows(), ≥ 0), which stands on their diagonal as −compliance. Both are read where
  // they are.
  void SetElastic(const VectorX* curvature, const VectorX* compliance);

  // Least-squares multipliers of the rows at a point: min ‖∇f + Jᵀ y − z_l + z_u‖. False if J has no full rank there.
  bool LeastSquaresMultipliers(const VectorX& objective_gradient, Multipliers* multipliers);

  // Multipliers of the rows to start from at a point: the least-squares ones, or 0 where the largest is beyond
  // `most`. Fills the Jacobian. False if it is not finite.
  bool StartRowMultipliers(const BarrierProblem::Point& point, const VectorX& objective_gradient, double most,
                           Multipliers* multipliers);

  // Factors the system at a point, whose Jacobian and Hessian are in kkt(), and solves it. False if no shift helps.
  // lagrangian: ∇f + Aᵀ y by w, without the multipliers of bounds.
  bool Compute(const BarrierProblem::Point& point, const Multipliers& multipliers, const VectorX& lagrangian, double mu,
               NewtonStep* step);
  // With the last factors, for other values of the constraints.
  bool Solve(const BarrierProblem::Point& point, const Multipliers& multipliers, const VectorX& c, double mu,
             NewtonStep* step);

  // With the last factors, the step corrected for centrality (Gondzio, Computational Optimization and Applications 6,
  // 1996): the products of distance and multiplier that a longer step, `primal` and `dual` of the given one, would
  // leave outside [0.1 μ, 10 μ] are aimed at its ends.
  bool Recentre(const BarrierProblem::Point& point, const Multipliers& multipliers, double mu, const NewtonStep& step,
                double primal, double dual, NewtonStep* recentred);

 private:
  // right: that of the gradients; excess: what the targets of the products differ from μ, divided by the distances.
  bool Solve(const BarrierProblem::Point& point, const Multipliers& multipliers, const VectorX& c, double mu,
             const VectorX& right, const Multipliers& excess, NewtonStep* step);
  bool Factorise(double mu);
  double HessianNorm();
  bool TryShift(double shift, double mu);

  BarrierProblem& barrier_;
  KktSystem kkt_;
  const double first_shift_;
  double shift_ = 0, last_shift_ = 0;
  int zero_failures_ = 0, skipped_ = 0;  // of the unshifted matrix: failures in a row; iterations since the last trial
  bool degenerate_ = false;              // the present matrix is singular without a dual shift
  VectorX sigma_;                        // unknowns(): curvature of the bounds
  VectorX right_;                        // unknowns(): negative gradient of the barrier Lagrangian
  Multipliers no_excess_, excess_;       // of targets
  VectorX shifted_right_;
  VectorX primal_diagonal_, dual_diagonal_, a_, b_, x_;
  VectorX slack_compliance_;  // of slacks: 1 / (σ + δ_w)
  const VectorX* elastic_curvature_ = nullptr;
  const VectorX* elastic_compliance_ = nullptr;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_NEWTON_STEP_H_
