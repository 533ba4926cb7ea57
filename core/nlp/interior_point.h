#ifndef ROLLGAIT_CORE_NLP_INTERIOR_POINT_H_
#define ROLLGAIT_CORE_NLP_INTERIOR_POINT_H_

#include "core/nlp/interior_point_state.h"
#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// What became of an interior point solve.
struct InteriorPointResult {
  NlpResult result;
  // True if no step is acceptable and the restoration phase is of no use (nothing is violated) or failed: another
  // method must go on from result.x.
  bool needs_restoration = false;
};

// Primal-dual interior point method with a filter line search (Wächter and Biegler, Math. Program. 106, 2006: the
// algorithm and the constants of Ipopt), on factors that follow the problem's elimination groups. Exact Hessian,
// inertia correction, second-order corrections, monotone barrier parameter, restoration phase (restoration.h), whose
// iterations are marked in IterationInfo. May run in several threads at once, one
// problem each. A resumed solve counts iterations and time from its first start, and does not report the iteration it
// goes on from again.
InteriorPointResult SolveWithInteriorPoint(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                                           const SolveControl& control, const Resumption& resumption = {});

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_INTERIOR_POINT_H_
