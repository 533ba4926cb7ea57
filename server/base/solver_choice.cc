#include "server/base/solver_choice.h"

#include <unistd.h>
#ifdef __x86_64__
#include <cpuid.h>
#endif

namespace rollgait::server {
namespace {

bool ProcessorRunsX8664V3() {
#if !defined(__x86_64__)
  return false;
#elif defined(__clang__)
  // clang 14 knows no level by its name, and three of this one's features by none.
  unsigned a = 0, b = 0, c = 0, d = 0;
  const unsigned both = bit_F16C | bit_MOVBE;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & both) != both) return false;
  if (__get_cpuid(0x80000001, &a, &b, &c, &d) == 0 || (c & bit_LZCNT) == 0) return false;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("fma");
#else
  return __builtin_cpu_supports("x86-64-v3") != 0;
#endif
}

}  // namespace

SecondSolver SecondSolverHere() { return {ROLLGAIT_HAS_X86_64_V3 != 0, ProcessorRunsX8664V3()}; }

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
