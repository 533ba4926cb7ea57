#ifndef ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_
#define ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_

#include <algorithm>
#include <functional>

#include "core/base/types.h"
#include "core/nlp/nlp_solver.h"

namespace rollgait {

// Where a solve starts. Empty multipliers: a cold start.
struct NlpStart {
  VectorX x;
  VectorX constraint_multipliers;
  VectorX lower_bound_multipliers;
  VectorX upper_bound_multipliers;
};

struct NlpOptions {
  NlpSolver solver = NlpSolver::kInteriorPoint;  // whom SolveNlp asks
  double tolerance = 1e-6;
  int max_iterations = 1000;
  double max_wall_time_s = 600;
  double initial_barrier = 0.1;   // μ₀; small for a warm start
  double barrier_tolerance = 10;  // κ_ε: μ falls once its problem is solved to an error of κ_ε μ
  // How far from its bounds a warm start begins, relative to their size or distance, at most 0.01; 0: μ₀.
  double warm_push = 0;
  // Of a start that is close to a solution but brings no multipliers: those of bounds are μ₀ over the distance from the
  // bound, those of rows are least squares, however large, and the distance from bounds is that of a warm start.
  bool estimate_multipliers = false;
  double barrier_exponent = 1.5;  // θ_μ: the next μ is at least μ^θ_μ
  // Whether a step that bounds cut short is tried again with Gondzio's correction for centrality.
  bool recentre = false;
  // Backward error at which the refinement of a Newton step ends. Near a solution coarser steps do; in a cold
  // start they cost iterations.
  double step_residual = 1e-10;
  // δ_w of the first Hessian that must be shifted. A smaller one that does not do costs a factorisation more, a larger
  // one a good step.
  double first_shift = 1e-4;
  // Asked once, with the first iterate whose errors are below `rough_tolerance`, whether to go on to `tolerance`; if
  // not, the solve ends there with NlpResult::rough. Empty: it goes on.
  std::function<bool(const VectorX& x)> worth_finishing = nullptr;
  double rough_tolerance = 0;
  int mesh = 0;  // passed on with every iteration

  // How far a solver moves bounds outwards, relative to their size where that is above 1, so that every problem has an
  // interior: 1e-8, and with a tolerance below 1e-6 a hundredth of that, since an objective cannot be more exact than
  // the bounds that hold it.
  double BoundRelaxation() const { return std::min(1e-8, tolerance / 100); }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_NLP_OPTIONS_H_
