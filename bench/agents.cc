// A sweep of planar solves by several agents on one PostgreSQL, and what the queue itself takes: the same sweep with a
// solver that answers at once. All is queued before the first agent starts, so a slot that is free while a solve waits
// is free because of the queue; with fewer cores than slots, the cores are what the solvers wait for.
//   agents [--solves N] [--slots S] [--solver PATH]
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

extern char** environ;

namespace rollgait::server {
namespace {

// A rollgait-agent with a directory of its own.
class AgentProcess {
 public:
  AgentProcess(const std::string& url, const std::string& work_dir, const std::string& solver, int slots) {
    std::vector<std::string> arguments = {ROLLGAIT_AGENT,        "--store",  url,    "--work-dir",  work_dir, "--slots",
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

// From the first claim on, in s.
struct Timeline {
  double span = 0;            // to the last end
  double queued = 0;          // to the last claim: so long a solve waited
  double running = 0;         // solves × time of that
  double some_slot_free = 0;  // of that
};

double Seconds(const google::protobuf::Timestamp& time) {
  return static_cast<double>(time.seconds()) + 1e-9 * time.nanos();
}

Timeline TimelineOf(const std::vector<v1::Solve>& solves, int slots) {
  std::vector<std::pair<double, int>> changes;
  Timeline line;
  double last_claim = 0;
  for (const v1::Solve& solve : solves) {
    changes.emplace_back(Seconds(solve.start_time()), 1);
    changes.emplace_back(Seconds(solve.end_time()), -1);
    last_claim = std::max(last_claim, Seconds(solve.start_time()));
  }
  std::sort(changes.begin(), changes.end());
  line.span = changes.back().first - changes.front().first;
  line.queued = last_claim - changes.front().first;
  int running = 0;
  for (size_t i = 0; changes[i].first < last_claim; ++i) {
    running += changes[i].second;
    const double time = changes[i + 1].first - changes[i].first;
    line.running += running * time;
    if (running < slots) line.some_slot_free += time;
  }
  return line;
}

// Waits for the end of a solve.
v1::Solve End(v1::GaitService::Stub& stub, const std::string& name) {
  {
    grpc::ClientContext context;
    v1::WatchSolveRequest request;
    request.set_name(name);
    const auto stream = stub.WatchSolve(&context, request);
    v1::SolveEvent event;
    while (stream->Read(&event)) {
    }
  }
  grpc::ClientContext context;
  v1::GetSolveRequest request;
  request.set_name(name);
  v1::Solve solve;
  const grpc::Status status = stub.GetSolve(&context, request, &solve);
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.error_message().c_str());
  return solve;
}

void Print(const char* what, const Sweep& sweep, const std::vector<v1::Solve>& solves) {
  const int slots = sweep.agents * sweep.slots;
  int optimal = 0, ended = 0;
  double cpu = 0;
  for (const v1::Solve& solve : solves) {
    ended += solve.has_start_time() && solve.has_end_time() ? 1 : 0;
    optimal += solve.result().termination() == v1::TERMINATION_OPTIMAL ? 1 : 0;
    cpu += solve.result().cpu_time_s();
  }
  if (ended < sweep.solves) {
    std::printf("| %s | %d × %d | %d of %d ended |\n", what, sweep.agents, sweep.slots, ended, sweep.solves);
    return;
  }
  const Timeline line = TimelineOf(solves, slots);
  const double cores = std::thread::hardware_concurrency();
  std::printf("| %s | %d × %d | %d of %d | %.1f | %.2f | %.1f %% | %.1f | %.0f %% |\n", what, sweep.agents, sweep.slots,
              optimal, sweep.solves, line.span, sweep.solves / line.span, 100 * line.running / (slots * line.queued),
              1000 * line.some_slot_free / sweep.solves, 100 * cpu / (cores * line.span));
  std::fflush(stdout);
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
  std::vector<std::unique_ptr<AgentProcess>> agents;
  for (int i = 0; i < sweep.agents; ++i) {
    agents.push_back(std::make_unique<AgentProcess>(cluster.Url(), directory.path() + "/agent" + std::to_string(i),
                                                    sweep.solver, sweep.slots));
  }
  std::vector<v1::Solve> solves;
  for (const std::string& name : names) solves.push_back(End(*stub, name));
  Print(what, sweep, solves);
}

int Main(int argc, char** argv) {
  Sweep sweep;
  std::string solver = ROLLGAIT_SOLVE;
  CLI::App app("A sweep by several agents on one PostgreSQL.", "agents");
  app.add_option("--solves", sweep.solves)->check(CLI::Range(1, 100'000))->capture_default_str();
  app.add_option("--slots", sweep.slots, "of each agent")->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--solver", solver, "Path of rollgait-solve");
  CLI11_PARSE(app, argc, argv);
  if (sweep.solves <= 3 * sweep.slots) {
    std::fprintf(stderr, "--solves must be more than 3 × --slots, or none would wait\n");
    return 2;
  }
  std::printf(
      "| solver | agents × slots | optimal | s | solves/s | slots taken while a solve waited | "
      "a slot free while one waited, ms a solve | cores busy with solving |\n|---|---|---|---|---|---|---|---|\n");
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
