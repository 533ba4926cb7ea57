#ifndef ROLLGAIT_TESTS_FAULTS_FAULTS_H_
#define ROLLGAIT_TESTS_FAULTS_FAULTS_H_

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/faults/load.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::faults {

struct FaultOptions {
  int count = 5;             // how often the fault happens
  bool judge_times = false;  // fail where a time of the acceptance table is exceeded; else it is only reported
  unsigned seed = 1;
};

struct FaultReport {
  std::string fault;
  std::string asked;
  std::string measured;
  bool good = false;
  std::string skipped;  // why this machine cannot do it; empty: it was done
};

FaultReport KillServer(const FaultOptions& options);
FaultReport KillAgent(const FaultOptions& options);
FaultReport KillSolver(const FaultOptions& options);
// SIGTERM instead of SIGKILL.
FaultReport StopServer(const FaultOptions& options);
// SIGSTOP of an agent until another has taken its solves.
FaultReport FreezeAgent(const FaultOptions& options);
FaultReport FillDisk(const FaultOptions& options);
FaultReport JumpClocks(const FaultOptions& options);
FaultReport CutNetwork(const FaultOptions& options);
FaultReport FloodDescriptors(const FaultOptions& options);
// With the solves in PostgreSQL; each time a pair of its own.
FaultReport FailOverPostgres(const FaultOptions& options);

// A rollgaitd with the slow solver that can be started again on its address.
class FaultyServer {
 public:
  // What is left empty is a new directory, any port, the server's own command.
  explicit FaultyServer(server::Daemon::Options options = {});
  FaultyServer(const FaultyServer&) = delete;
  FaultyServer& operator=(const FaultyServer&) = delete;

  server::Daemon& daemon() { return *daemon_; }
  const std::string& address() const { return address_; }
  const std::string& data_dir() const { return options_.data_dir; }
  // Starts the server again, once it was ended. Returns the seconds from its start to its first answer.
  double Restart();

 private:
  server::TemporaryDirectory directory_;
  server::Daemon::Options options_;
  std::string address_;
  std::vector<std::unique_ptr<server::Daemon>> past_;  // their end would kill agents, which outlive them here
  std::unique_ptr<server::Daemon> daemon_;
};

// Seconds until a new connection gets an answer; throws after a minute.
double SecondsToAnswer(const std::string& address);
// Waits until the condition holds; throws std::runtime_error with `what` after two minutes.
void Await(const std::string& what, const std::function<bool()>& condition);

// "0.42 s"
std::string SecondsText(double seconds);

}  // namespace rollgait::faults

#endif  // ROLLGAIT_TESTS_FAULTS_FAULTS_H_
