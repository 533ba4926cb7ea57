#ifndef ROLLGAIT_CLIENT_COMMANDS_CREATE_SOLVE_H_
#define ROLLGAIT_CLIENT_COMMANDS_CREATE_SOLVE_H_

#include <string>

#include "client/connection.h"

namespace rollgait::client {

// An id that no other request has, so that a creation whose answer was lost can be repeated.
std::string RandomRequestId();

// Creates the solve, or validates the request if it asks for that. A connection that breaks after the request was sent
// is tried once more: the request id makes that safe. Throws Failure.
v1::Solve CreateSolve(Connection& connection, const v1::CreateSolveRequest& request);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_CREATE_SOLVE_H_
