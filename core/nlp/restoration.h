#ifndef ROLLGAIT_CORE_NLP_RESTORATION_H_
#define ROLLGAIT_CORE_NLP_RESTORATION_H_

#include <functional>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/newton_step.h"
#include "core/nlp/optimality.h"
#include "core/nlp/restoration_state.h"
#include "core/nlp/step_acceptance.h"

namespace rollgait {

// The restoration phase of an interior point method (Wächter and Biegler, Math. Program. 106, 2006, section 3.3). From
// a point w_R where no step is acceptable it seeks one that satisfies the constraints better, by the same method
// applied to
//   minimise  ρ Σ (p + n) + ½ √μ ‖D (x − x_R)‖²   subject to  c(w) − p + n = 0,  l ≤ w ≤ u,  p, n ≥ 0,
// D = 1 / max(1, |x_R|). Each row has its own p and n, so they are eliminated before anything else,
//   Δp = (Δy + y − ρ + μ/p) p/z_p,   Δn = (−Δy − y − ρ + μ/n) n/z_n,
// which leaves −(p/z_p + n/z_n) on the row's diagonal of the Newton system: its stages stay what they are. Rows without
// bounds have neither. Differs from Ipopt: there is no second-order correction; where the line search fails, p and n
// are set to their minimum at the present w, once.
class Restoration {
 public:
  using Point = BarrierProblem::Point;
  enum class End {
    kRestored,    // point() is acceptable
    kInfeasible,  // point() is a local minimum of the sum of violations, which is not 0
    kStopped,
    kFailed,
  };

  // How the solve watches its iterates.
  struct Watch {
    std::function<bool(const Point&)> is_acceptable;  // asked for every iterate
    std::function<bool()> goes_on;                    // asked for every iterate that is not acceptable; false: kStopped
  };

  // Both outlive this object; what `newton` has learnt is as before when Run or Resume returns, its matrices are not.
  Restoration(BarrierProblem& barrier, NewtonSystem& newton, const NlpOptions& options);

  // The barrier parameter is that of the solve, `mu`, or the largest violation, if that is larger.
  End Run(const Point& from, const Multipliers& multipliers, double mu, const Watch& watch);
  // Goes on from a state of a phase that began at the same point, after goes_on has been asked for it. It takes the
  // steps of a phase that was not interrupted. Contract: the sizes fit, and w is within the bounds.
  End Resume(const Point& from, const RestorationState& state, const Watch& watch);
  // From which Resume goes on. Contract: goes_on is being asked.
  RestorationState State() const;
  // What the Newton system had learnt where the phase began, which it will know again where it ends.
  const NewtonSystem::Memory& newton_before() const { return newton_before_; }

  // Of the present iterate.
  const Point& point() const { return point_; }
  const OptimalityError& error() const { return error_; }  // of the problem of restoration
  double mu() const { return parameter_.mu(); }
  double primal_step() const { return primal_step_; }
  double dual_step() const { return dual_step_; }
  double step_norm() const { return step_norm_; }
  int trials() const { return trials_; }

 private:
  bool Begin(const Multipliers& multipliers, double mu);
  bool Restore(const RestorationState& state);
  End Iterate(const Watch& watch, bool is_first);
  End Finish(End end);
  void SetReference(const Point& from);
  void MinimiseElastic();
  // All that depends on the point and the multipliers, the error among it. To be called whenever one of them changes.
  bool Linearise();
  void FillLagrangian();
  OptimalityError ErrorAt(double mu);
  bool ComputeStep();
  bool ComputeStepWithoutCurvature();
  void LinearChange();
  bool LineSearch();
  LinePoint At(const Point& point, const ElasticVariables& elastic) const;
  double Slope();
  void Accept(double alpha);
  double eta() const;
  bool is_elastic(int row) const { return is_elastic_(row) != 0; }

  BarrierProblem& barrier_;
  NewtonSystem& newton_;
  const NlpOptions& options_;
  BarrierParameter parameter_;
  VectorX is_elastic_;               // rows(): 1, or 0 in rows without bounds
  VectorX reference_, scale_;        // x_R and D² (variables())
  Point point_, trial_, effective_;  // effective_: c as it stands in the Newton system
  ElasticVariables elastic_, trial_elastic_, elastic_step_;
  Multipliers multipliers_;
  NewtonStep step_;
  StepAcceptance acceptance_;
  OptimalityError error_;
  VectorX proximity_;   // its gradient by x
  VectorX lagrangian_;  // by w, without the multipliers of bounds
  VectorX gradient_;    // Aᵀ y by w
  VectorX change_, curvature_, compliance_, objective_gradient_, barrier_gradient_;
  NewtonSystem::Memory newton_before_;
  double primal_step_ = 0, dual_step_ = 0, step_norm_ = 0;
  int trials_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_RESTORATION_H_
