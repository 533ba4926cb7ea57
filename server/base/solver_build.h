#ifndef ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_
#define ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_

#include <string>

namespace rollgait::server {

// What made a result: version, compiler, Ipopt and kind of build, for example
// "rollgait 0.1.0 (GNU 12.2.0, Release, Ipopt 3.11.9)". The same in all programs of one build.
std::string SolverBuild();

// "0.1.0"
std::string RollgaitVersion();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SOLVER_BUILD_H_
