// An agent that stands still while its leases expire, and then goes on.
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "server/store/open_store.h"
#include "tests/faults/faults.h"

extern char** environ;

namespace rollgait::faults {
namespace {

// A rollgait-agent beside the server's own, until its end.
class SecondAgent {
 public:
  explicit SecondAgent(const std::string& data_dir) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    std::vector<std::string> arguments = {ROLLGAIT_AGENT, "--data-dir", data_dir, "--slots", "4",
                                          "--solver",     SLOW_SOLVER};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int failed = posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    lifeline_ = ends[1];
    if (failed != 0) throw std::runtime_error("the second agent does not start");
  }
  SecondAgent(const SecondAgent&) = delete;
  SecondAgent& operator=(const SecondAgent&) = delete;
  ~SecondAgent() {
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
    close(lifeline_);
  }

 private:
  pid_t pid_ = 0;
  int lifeline_ = -1;
};

// True if the process holds the writer's lock of the SQLite store: byte 120 of the shared memory file beside it.
bool HoldsWriterLock(pid_t pid, const std::string& data_dir) {
  struct stat shared {};
  if (stat((data_dir + "/rollgait.db-shm").c_str(), &shared) != 0) return false;
  std::ifstream locks("/proc/locks");
  std::string number, kind, advisory, access, file;
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    pid_t holder = 0;
    int64_t first = 0;
    words >> number >> kind >> advisory >> access >> holder >> file >> first;
    const bool same_file = file.substr(file.rfind(':') + 1) == std::to_string(shared.st_ino);
    if (holder == pid && same_file && access == "WRITE" && first == 120) return true;
  }
  return false;
}

// True if the agent has solves that only its lease keeps from others.
bool HoldsLease(pid_t agent, server::SolveStore& store) {
  const auto owners = store.LeaseOwners();
  if (!owners.ok()) throw std::runtime_error(owners.error().message);
  const std::string prefix = "agent-" + std::to_string(agent) + "-";
  return std::any_of(owners.value().begin(), owners.value().end(),
                     [&](const server::LeaseOwner& owner) { return owner.owner.starts_with(prefix); });
}

// Stops the agent while it holds solves, between two of its transactions. In one it would hold the store's one writer's
// lock for as long as it stands still: SQLite cannot take a lock from a living process (PostgreSQL can: that is what it
// is for).
void Freeze(pid_t agent, const std::string& data_dir, server::SolveStore& store) {
  Await("a moment between two transactions with solves at work", [&] {
    kill(agent, SIGSTOP);
    if (!HoldsWriterLock(agent, data_dir) && HoldsLease(agent, store)) return true;
    kill(agent, SIGCONT);
    return false;
  });
}

}  // namespace

FaultReport FreezeAgent(const FaultOptions& options) {
  FaultyServer server;
  Load load({server.address()});
  load.AwaitRound();  // the server's own agent is at work on all of them
  const std::vector<pid_t> agents = server::AgentsOf(server.data_dir());
  if (agents.size() != 1) throw std::runtime_error("the server has not one agent");
  const server::SystemClock clock;
  const auto store = server::OpenStore({.sqlite_path = server.data_dir() + "/rollgait.db"}, clock);
  if (!store.ok()) throw std::runtime_error(store.error().message);
  std::unique_ptr<SecondAgent> second;
  for (int i = 0; i < options.count; ++i) {
    Freeze(agents[0], server.data_dir(), *store.value());
    if (second == nullptr) second = std::make_unique<SecondAgent>(server.data_dir());
    load.AwaitRound();  // also those whose agent stands still
    kill(agents[0], SIGCONT);
    load.AwaitRound();
  }
  const Verdict verdict = load.Finish();
  FaultReport report{"SIGSTOP of an agent beyond its lease × " + std::to_string(options.count),
                     "another takes over after the lease; what the first writes then changes nothing", verdict.Text(),
                     verdict.good() && verdict.retried > 0, ""};
  return report;
}

}  // namespace rollgait::faults
