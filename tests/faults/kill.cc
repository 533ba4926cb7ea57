// Processes that end at once: rollgaitd, its agent, a solver.
#include <signal.h>
#include <sys/syscall.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <thread>

#include "tests/faults/faults.h"

namespace rollgait::faults {
namespace {

using server::AgentsOf;
using server::ChildrenOf;

// Some time for the load to do something, different each time.
void LetItWork(std::mt19937& random) { std::this_thread::sleep_for(std::chrono::milliseconds(100 + random() % 500)); }

// True if a process waits in read: a solver that has no request yet.
bool IsIdle(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/syscall");
  long call = -1;
  return file >> call && call == SYS_read;
}

FaultReport EndServer(const FaultOptions& options, bool politely) {
  FaultyServer server;
  Load load({server.address()});
  std::mt19937 random(options.seed);
  double longest_start = 0, longest_stop = 0;
  int bad_exits = 0;
  for (int i = 0; i < options.count; ++i) {
    LetItWork(random);
    const auto start = std::chrono::steady_clock::now();
    if (politely) {
      bad_exits += server.daemon().Terminate() == 0 ? 0 : 1;
    } else {
      server.daemon().Kill();
    }
    longest_stop =
        std::max(longest_stop, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    longest_start = std::max(longest_start, server.Restart());
  }
  const Verdict verdict = load.Finish();
  FaultReport report;
  report.fault = (politely ? "SIGTERM of rollgaitd × " : "kill -9 of rollgaitd × ") + std::to_string(options.count);
  report.asked = politely ? "exit 0 within 30 s; watchers re-attach; nothing lost"
                          : "serving again ≤ 2 s after restart; nothing lost";
  report.measured =
      (politely ? std::to_string(bad_exits) + " exits other than 0, longest stop " + SecondsText(longest_stop)
                : "serving after at most " + SecondsText(longest_start)) +
      "; " + verdict.Text();
  report.good = verdict.good() && bad_exits == 0 &&
                (!options.judge_times || (politely ? longest_stop <= 30 : longest_start <= 2));
  return report;
}

}  // namespace

FaultReport KillServer(const FaultOptions& options) { return EndServer(options, false); }

FaultReport StopServer(const FaultOptions& options) { return EndServer(options, true); }

FaultReport KillAgent(const FaultOptions& options) {
  FaultyServer server;
  Load load({server.address()});
  std::mt19937 random(options.seed);
  for (int i = 0; i < options.count; ++i) {
    const int64_t finished = load.finished();
    Await("solves of the new agent", [&] { return load.finished() > finished; });
    LetItWork(random);
    for (const pid_t agent : AgentsOf(server.data_dir())) kill(agent, SIGKILL);
  }
  const Verdict verdict = load.Finish();
  FaultReport report{"kill -9 of the agent × " + std::to_string(options.count), "retried within 20 s; nothing lost", "",
                     false, ""};
  report.measured = verdict.Text();
  report.good = verdict.good() && verdict.retried > 0 && (!options.judge_times || verdict.longest_retry_s <= 20);
  return report;
}

FaultReport KillSolver(const FaultOptions& options) {
  FaultyServer server;
  Load load({server.address()});
  std::mt19937 random(options.seed);
  for (int i = 0; i < options.count; ++i) {
    LetItWork(random);
    Await("a solver", [&] {
      std::vector<pid_t> solvers;
      for (const pid_t agent : AgentsOf(server.data_dir())) {
        for (const pid_t child : ChildrenOf(agent)) {
          if (!IsIdle(child)) solvers.push_back(child);
        }
      }
      return !solvers.empty() && kill(solvers[random() % solvers.size()], SIGKILL) == 0;
    });
  }
  const Verdict verdict = load.Finish();
  FaultReport report{"kill -9 of a solver × " + std::to_string(options.count), "retried within 1 s; nothing lost", "",
                     false, ""};
  report.measured = verdict.Text();
  report.good = verdict.good() && (!options.judge_times || verdict.longest_retry_s <= 1);
  return report;
}

}  // namespace rollgait::faults
