#ifndef ROLLGAIT_CORE_GAIT_ADOPT_SOLUTION_H_
#define ROLLGAIT_CORE_GAIT_ADOPT_SOLUTION_H_

#include "core/gait/gait_solver.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// What one NLP of the spec was, how it ended, its size and effort.
MeshStatistics Describe(const GaitSpec& spec, StartOf start, const CollocationNlp& nlp, const NlpResult& result);

// Puts the solution of one NLP, judged, into `solution`; the judgement goes into its statistics too. The iterate must
// be finite.
void Adopt(const GaitSpec& spec, const OptimalControlProblem& problem, CollocationNlp& nlp, const NlpResult& result,
           GaitSolution* solution, MeshStatistics* statistics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ADOPT_SOLUTION_H_
