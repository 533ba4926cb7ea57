#include "server/base/solver_choice.h"

#include <unistd.h>

namespace rollgait::server {
namespace {

bool ProcessorHasV3() {
#if ROLLGAIT_HAS_X86_64_V3
  return __builtin_cpu_supports("x86-64-v3");
#else
  return false;
#endif
}

}  // namespace

std::vector<std::string> InstructionSetWishes() { return {"auto", "baseline", "x86-64-v3"}; }

Outcome<SolverChoice> ChooseSolver(const std::string& folder, const std::string& wish) {
  SolverChoice baseline;
  baseline.program = folder + "/rollgait-solve";
  if (wish == "baseline") return baseline;
  SolverChoice fast;
  fast.program = folder + "/rollgait-solve-v3";
  fast.set = InstructionSet::kX8664V3;
  const bool there = access(fast.program.c_str(), X_OK) == 0;
  if (ProcessorHasV3() && there) return fast;
  if (wish == "x86-64-v3") {
    const std::string reason = !ROLLGAIT_HAS_X86_64_V3 ? "this build made no solver for it"
                               : there                 ? "this processor does not have it"
                                                       : fast.program + " is missing";
    return Error{ErrorCode::kUnavailable, "--instruction-set x86-64-v3: " + reason};
  }
  if (ProcessorHasV3()) baseline.remark = fast.program + " is missing; solves run with the slower " + baseline.program;
  return baseline;
}

}  // namespace rollgait::server
