#ifndef ROLLGAIT_CLIENT_COMMANDS_SOLVE_ITERATIONS_H_
#define ROLLGAIT_CLIENT_COMMANDS_SOLVE_ITERATIONS_H_

#include <vector>

#include "client/connection.h"
#include "client/terminal.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// The lines of the solver's log of a finished solve, in order. Empty, with a word on terminal.err, if the server no
// longer holds them (retention). Throws Failure.
std::vector<v1::Iteration> ReadIterations(Connection& connection, const v1::Solve& solve, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_SOLVE_ITERATIONS_H_
