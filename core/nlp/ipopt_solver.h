#ifndef ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_
#define ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_

#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// Interior point method of Wächter and Biegler with MUMPS, exact Hessian. MUMPS is not reentrant: one solve at a time
// in a process, whatever the thread. The result holds the last iterate, whatever the termination.
NlpResult SolveWithIpopt(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                         const SolveControl& control);

// Version of the library, for example "Ipopt 3.14.17".
std::string IpoptVersion();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_IPOPT_SOLVER_H_
