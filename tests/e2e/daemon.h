#ifndef ROLLGAIT_TESTS_E2E_DAEMON_H_
#define ROLLGAIT_TESTS_E2E_DAEMON_H_

#include <grpcpp/grpcpp.h>
#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::server {

// The real rollgaitd as a process, with its own agent. Killed with its agents and solvers at the end.
class Daemon {
 public:
  struct Options {
    std::string data_dir;
    std::string listen = "127.0.0.1:0";
    std::string solver;              // path
    std::vector<std::string> flags;  // more of them
    std::vector<std::string> launcher =
        {};                     // a command that the server's own is put behind and that becomes it: env, prlimit …
    std::string log_file = {};  // of its and its agent's standard error; empty: that of the test
  };
  // Starts the server and waits until it listens. If it does not, address() is empty and ExitCode() tells why.
  explicit Daemon(const Options& options);
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  const std::string& address() const { return address_; }
  pid_t pid() const { return pid_; }
  // kill -9, waits for its end. The agent stays.
  void Kill();
  // SIGTERM, waits for its end and returns the exit code.
  int Terminate();
  // Waits for its end and returns the exit code; 128 + number if a signal ended it.
  int ExitCode();
  std::unique_ptr<v1::GaitService::Stub> NewStub() const;

 private:
  const std::string data_dir_;
  pid_t pid_ = 0;
  int output_ = -1;
  std::string address_;
};

// The standard output of `rollgaitd ARGUMENTS`, without its last line feed; throws std::runtime_error if the command
// fails.
std::string OutputOfRollgaitd(const std::string& arguments);
// Agents that work on a data directory, that of a dead server included.
std::vector<pid_t> AgentsOf(const std::string& data_dir);
// Children of a process.
std::vector<pid_t> ChildrenOf(pid_t parent);
// kill -9 of all agents of a data directory and of their solvers.
void KillAgents(const std::string& data_dir);

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_E2E_DAEMON_H_
