#ifndef ROLLGAIT_CORE_NLP_NLP_SOLVER_H_
#define ROLLGAIT_CORE_NLP_NLP_SOLVER_H_

namespace rollgait {

// Who solves nonlinear programs. Mirrors rollgait.v1.NlpSolver.
enum class NlpSolver {
  kInteriorPoint,  // our own; Ipopt takes over where that is of no use (SolveNlp)
  kIpopt,          // Ipopt alone
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_NLP_SOLVER_H_
