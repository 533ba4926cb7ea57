#ifndef ROLLGAIT_CORE_NLP_SOLVE_NLP_H_
#define ROLLGAIT_CORE_NLP_SOLVE_NLP_H_

#include "core/nlp/interior_point_state.h"
#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// Solves a nonlinear program: by Ipopt, if NlpOptions::solver says so, else by the interior point method that follows
// the problem's elimination groups (interior_point.h), and, from the point where that one finds no acceptable step and
// its restoration phase is of no use, by Ipopt. Iterations are numbered through; those of Ipopt count as restoration in
// IterationInfo, and NlpResult::restored_from says where they began. States are kept of the interior point method, its
// restoration phase included: a solve that is resumed after Ipopt has taken over goes on from before that.
// NlpResult::evaluation_time_s is that since the resumption.
NlpResult SolveNlp(NlpProblem& problem, const NlpStart& start, const NlpOptions& options, const SolveControl& control,
                   const Resumption& resumption = {});

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_SOLVE_NLP_H_
