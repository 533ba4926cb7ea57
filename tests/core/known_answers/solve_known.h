#ifndef ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_SOLVE_KNOWN_H_
#define ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_SOLVE_KNOWN_H_

#include "core/nlp/result.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

enum class KnownSolver { kOwn, kIpopt };

struct KnownSolution {
  std::unique_ptr<CollocationNlp> nlp;
  NlpResult result;
  double objective = 0;
};
// One solve, from the problem's guess or, with its multipliers, from a solution on another
// mesh. The own solver takes no help from Ipopt: where it finds no acceptable step it ends with kNumericalDifficulty.
// The problem must outlive the solution.
KnownSolution SolveKnown(const KnownProblem& known, Scheme scheme, const Mesh& mesh,
                         const KnownSolution* from = nullptr, KnownSolver solver = KnownSolver::kOwn);

// The solutions of a run, and how far its last one is from the known answer. The error bar is twice what that one
// differs by from the solution on the mesh that halves its intervals again, which is no less than the error where each
// halving takes half of it at least, and the share of rounding.
struct KnownError {
  std::vector<KnownSolution> solutions;  // from the coarse mesh to the last
  KnownSolution halved;
  double error = 0, bar = 0;  // relative
  double order = 0;           // in which the error fell in the last halving; NaN without one
  bool converged = true;      // all of them
};
KnownError MeasureError(const KnownProblem& known, const KnownRun& run);

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_SOLVE_KNOWN_H_
