#include "server/base/solver_choice.h"

#include <unistd.h>

namespace rollgait::server {

SecondSolver SecondSolverHere() {
#ifdef __x86_64__
  return {ROLLGAIT_HAS_X86_64_V3 != 0, __builtin_cpu_supports("x86-64-v3") != 0};
#else
  return {ROLLGAIT_HAS_X86_64_V3 != 0, false};
#endif
}

std::vector<std::string> InstructionSetWishes() { return {"auto", "baseline", "x86-64-v3"}; }

Outcome<SolverChoice> ChooseSolver(const std::string& folder, const std::string& wish, SecondSolver second) {
  SolverChoice baseline;
  baseline.program = folder + "/rollgait-solve";
  if (wish == "baseline") return baseline;
  SolverChoice fast;
  fast.program = folder + "/rollgait-solve-v3";
  fast.set = InstructionSet::kX8664V3;
  const bool there = access(fast.program.c_str(), X_OK) == 0;
  const bool suits = second.is_built && second.runs;
  if (suits && there) return fast;
  if (wish == "x86-64-v3") {
    const std::string reason = !second.is_built ? "this build made no solver for it"
                               : !second.runs   ? "this processor does not have it"
                                                : fast.program + " is missing";
    return Error{ErrorCode::kUnavailable, "--instruction-set x86-64-v3: " + reason};
  }
  if (suits) baseline.remark = fast.program + " is missing; solves run with the slower " + baseline.program;
  return baseline;
}

}  // namespace rollgait::server
