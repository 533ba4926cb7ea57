// Solves that a command reads from the server or from files.
#ifndef ROLLGAIT_CLIENT_COMMANDS_FINISHED_SOLVE_H_
#define ROLLGAIT_CLIENT_COMMANDS_FINISHED_SOLVE_H_

#include <memory>
#include <string>

#include "client/connection.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Whether `given` names a file, not a solve on the server.
bool IsSolveFile(const std::string& given);

// `given` is the name of a solve on the server, or a .json file of --output. The connection is made when the first name
// needs it. Throws Failure(kUsage) for a solve that still waits or runs, and as ReadJsonFile and Connection.
v1::Solve FinishedSolve(const std::string& given, const GlobalOptions& global, std::unique_ptr<Connection>& connection);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_FINISHED_SOLVE_H_
