#ifndef ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_
#define ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_

#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// Where a solve starts. Empty multipliers: a cold start.
struct NlpStart {
  VectorX x;
  VectorX constraint_multipliers;
  VectorX lower_bound_multipliers;
  VectorX upper_bound_multipliers;
};

struct IpoptOptions {
  double tolerance = 1e-6;
  int max_iterations = 1000;
  double max_wall_time_s = 600;
  double initial_barrier = 0.1;  // μ₀; small for a warm start
  int mesh = 0;                  // passed on with every iteration
};

// Interior point method of Wächter and Biegler with MUMPS, exact Hessian. MUMPS is not reentrant: one solve at a time in a
// process, whatever the thread. The result holds the last iterate, whatever the
// termination.
NlpResult SolveWithIpopt(NlpProblem& problem, const NlpStart& start, const IpoptOptions& options,
                         const SolveControl& control);

// Version of the library, for example "Ipopt 3.14.17".
std::string IpoptVersion();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_
