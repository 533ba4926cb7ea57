// A sweep of planar solves by several agents on one PostgreSQL, and what the queue itself takes: the same sweep with a
// solver that answers at once.
//   agents [--solves N] [--slots S] [--solver PATH]
#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

extern char** environ;

namespace rollgait::server {
namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// A rollgait-agent with a directory of its own.
class AgentProcess {
 public:
  AgentProcess(const std::string& url, const std::string& work_dir, const std::string& solver, int slots) {
    std::vector<std::string> arguments = {ROLLGAIT_AGENT, "--store", url, "--work-dir", work_dir, "--slots",
                                          std::to_string(slots), "--solver", solver, "--log-level", "error"};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ) != 0) std::abort();
    posix_spawn_file_actions_destroy(&actions);
  }
  AgentProcess(const AgentProcess&) = delete;
  AgentProcess& operator=(const AgentProcess&) = delete;
  ~AgentProcess() {
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_ = 0;
};

struct Sweep {
  std::string solver;
  int agents = 1, slots = 1, solves = 60;
  int iterations = 0;  // limit; 0: as many as it takes
};

std::string Create(v1::GaitService::Stub& stub, const Sweep& sweep, int i) {
  v1::CreateSolveRequest request;
  v1::SolveSpec& spec = *request.mutable_spec();
  spec.mutable_model()->set_name("planar");
  spec.set_slope_rad(0.01 * (i % 10 - 5));
  spec.mutable_motion()->set_speed_m_s(1.1 + 0.005 * i);
  if (sweep.iterations > 0) spec.mutable_solver_limits()->set_max_iterations(sweep.iterations);
  grpc::ClientContext context;
  v1::Solve solve;
  const grpc::Status status = stub.CreateSolve(&context, request, &solve);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.error_message().c_str());
  return solve.name();
}

void Run(const char* what, const Sweep& sweep) {
  const PostgresCluster cluster({.durable = true});
  const TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/server";
  options.solver = sweep.solver;
  options.flags = {"--store", cluster.Url(), "--log-level", "error"};
  const Daemon daemon(options);
  const auto stub = daemon.NewStub();
  std::vector<std::string> names;
  for (int i = 0; i < sweep.solves; ++i) names.push_back(Create(*stub, sweep, i));
  const Clock::time_point start = Clock::now();
  std::vector<std::unique_ptr<AgentProcess>> agents;
  for (int i = 0; i < sweep.agents; ++i) {
    agents.push_back(std::make_unique<AgentProcess>(cluster.Url(), directory.path() + "/agent" + std::to_string(i),
                                                    sweep.solver, sweep.slots));
  }
  int optimal = 0;
  for (const std::string& name : names) {
    grpc::ClientContext context;
    v1::WatchSolveRequest request;
    request.set_name(name);
    const auto stream = stub->WatchSolve(&context, request);
    v1::SolveEvent event;
    while (stream->Read(&event)) {
      optimal += event.has_finished() && event.finished().result().termination() == v1::TERMINATION_OPTIMAL ? 1 : 0;
    }
  }
  const double seconds = Since(start);
  std::printf("| %s | %d × %d | %d of %d | %.1f | %.2f | %.1f |\n", what, sweep.agents, sweep.slots, optimal, sweep.solves,
              seconds, sweep.solves / seconds, 1000 * seconds / sweep.solves);
  std::fflush(stdout);
}

int Main(int argc, char** argv) {
  Sweep sweep;
  std::string solver = ROLLGAIT_SOLVE;
  CLI::App app("A sweep by several agents on one PostgreSQL.", "agents");
  app.add_option("--solves", sweep.solves)->check(CLI::Range(1, 100'000))->capture_default_str();
  app.add_option("--slots", sweep.slots, "of each agent")->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--solver", solver, "Path of rollgait-solve");
  CLI11_PARSE(app, argc, argv);
  std::printf("| solver | agents × slots | optimal | s | solves/s | ms a solve |\n|---|---|---|---|---|---|\n");
  for (const int agents : {1, 3}) {
    sweep.agents = agents;
    sweep.solver = solver;
    sweep.iterations = 0;
    Run("rollgait-solve", sweep);
    sweep.solver = SLOW_SOLVER;
    sweep.iterations = 1;
    Run("one that answers after 10 ms: the queue alone", sweep);
  }
  return 0;
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
