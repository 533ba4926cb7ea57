#ifndef ROLLGAIT_SERVER_BASE_SOLVER_CHOICE_H_
#define ROLLGAIT_SERVER_BASE_SOLVER_CHOICE_H_

#include <string>
#include <vector>

#include "server/base/outcome.h"
#include "server/base/solver_build.h"

namespace rollgait::server {

// The rollgait-solve that solves are run with.
struct SolverChoice {
  std::string program;  // path
  InstructionSet set = InstructionSet::kBaseline;
  std::string remark;  // why it is not the fastest that the processor runs; empty: it is, or was asked for
};

// The values of --instruction-set.
std::vector<std::string> InstructionSetWishes();

// The solver for x86-64-v3: whether this build makes it, and whether this processor runs it.
struct SecondSolver {
  bool is_built = false, runs = false;
};
SecondSolver SecondSolverHere();

// Of the solvers that this build made, the one in `folder` that suits the processor ("auto") or the wish.
//   auto  x86-64-v3 where the processor has it, else the baseline; also where the file rollgait-solve-v3 is missing,
//   with a remark
// kUnavailable: what was asked for by name was not built, is not there or does not run on this processor.
Outcome<SolverChoice> ChooseSolver(const std::string& folder, const std::string& wish,
                                   SecondSolver second = SecondSolverHere());

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SOLVER_CHOICE_H_
