// What the client tells its caller when something does not go as asked.
#ifndef ROLLGAIT_CLIENT_FAILURE_H_
#define ROLLGAIT_CLIENT_FAILURE_H_

#include <grpcpp/support/status.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// The process's exit code; a contract with scripts, printed by `rollgait help exit-codes`.
enum class ExitCode {
  kSuccess =
      0,  // Done; a solve that was waited for is optimal or acceptable, and within its accuracy bounds if it has any.
  kInternal = 1,     // A defect, here or in the server, or an output that could not be written.
  kUsage = 2,        // The command line, or a request that the server refuses.
  kUnreachable = 3,  // No server, no answer in time, or the server is too busy.
  kNoSolution = 4,   // The run ended; the mathematics did not: infeasible or not converged.
  kRunFailed = 5,    // The run ended without an answer: crash, CPU limit, memory limit.
  kCancelled = 6,
  kNotFound = 7,
  kMissesBound =
      8,  // The solve is optimal or acceptable, but its trajectory misses an accuracy bound or an error of the request.
};

// Ends a command. Thrown anywhere in the client, turned into a message and an exit code in one place (RunClient).
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// The exit code of a call that ended with this status.
ExitCode ExitCodeOf(const grpc::Status& status);

// The exit code of a finished solve. kInternal for one that is not finished. A solve that was not judged is a success,
// unless its time was up: then only what is judged is a solution.
ExitCode ExitCodeOf(const v1::Solve& solve);
// Whether the request has a max_error that the finished solve's estimates are not within, or that it has no estimate
// for.
bool MissesMaxError(const v1::Solve& solve);
// True if the solve ended optimal or acceptable, or with a judged solution when its time was up, whatever its accuracy.
bool HasSolution(const v1::Solve& solve);

// Whose ranges and time limits a refusal speaks of.
enum class CallKind { kSolve, kScene };

// After how many seconds the server asks to try again; nullopt: it does not.
std::optional<double> RetryDelay(const grpc::Status& status);

// What went wrong and what to do next; several lines: one for each google.rpc.BadRequest violation ("field: message")
// found in the status's details.
//   action  what was tried, for example "create the solve"
//   server  HOST:PORT as given by the user
std::string Describe(const grpc::Status& status, const std::string& action, const std::string& server,
                     CallKind kind = CallKind::kSolve);

// Throws the Failure of a status that is not OK.
void RequireOk(const grpc::Status& status, const std::string& action, const std::string& server,
               CallKind kind = CallKind::kSolve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FAILURE_H_
