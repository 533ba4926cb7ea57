#ifndef ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_
#define ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_

#include <string>

namespace rollgait::server {

// What processors a program is built for.
enum class InstructionSet {
  kBaseline,  // every processor of the architecture
  kX8664V3,   // x86-64 with AVX2, BMI2 and FMA
};
// That of this program.
InstructionSet OwnInstructionSet();

// What made a result: version, compiler, Ipopt, kind of build and, if it is not the baseline, instruction set; for
// example "rollgait 0.1.0 (GNU 12.2.0, Release, Ipopt 3.11.9, x86-64-v3)". The two builds round differently.
std::string SolverBuild(InstructionSet set = OwnInstructionSet());

// "0.1.0"
std::string RollgaitVersion();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_
