// rollgait-agent: works on the solves of a store, each in a rollgait-solve of its own.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "server/agent/agent.h"
#include "server/base/digest.h"
#include "server/base/log_flags.h"
#include "server/base/logging.h"
#include "server/base/metrics.h"
#include "server/base/sandbox.h"
#include "server/base/solver_build.h"
#include "server/base/solver_choice.h"
#include "server/store/measured_store.h"
#include "server/store/open_store.h"

namespace rollgait::server {
namespace {

// Without a hint; PostgreSQL's come over the network and are seldom lost.
constexpr std::chrono::milliseconds kLookWithNotify{1000};

// Written to by the handler of SIGTERM and SIGINT.
int stop_pipe_write = -1;

void HandleStop(int) {
  const int before = errno;
  const char byte = 1;
  // A full pipe has been written to before.
  [[maybe_unused]] const ssize_t count = write(stop_pipe_write, &byte, 1);
  errno = before;
}

// The read end of a pipe that gets a byte when the process is told to stop; -1 if that fails.
int CatchStopSignals() {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return -1;
  stop_pipe_write = ends[1];
  struct sigaction action {};
  action.sa_handler = HandleStop;
  if (sigaction(SIGTERM, &action, nullptr) != 0 || sigaction(SIGINT, &action, nullptr) != 0) return -1;
  signal(SIGPIPE, SIG_IGN);
  return ends[0];
}

// Standard input if it is a pipe, whose end means that rollgaitd has died; else -1.
int Lifeline() {
  struct stat info {};
  const bool is_pipe = fstat(STDIN_FILENO, &info) == 0 && (S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode));
  return is_pipe ? STDIN_FILENO : -1;
}

std::string Folder() {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/self/exe", failure).parent_path().string();
}

int Fail(const std::string& reason) {
  spdlog::error("{}", reason);
  return 1;
}

// Flags that say where the solves are.
struct AgentPlace {
  std::string data_dir, store, work_dir;
};

// Where the solves are; sets what follows for the agent. kInvalidArgument names the flag that is missing or too much.
Outcome<StoreLocation> Locate(const AgentPlace& place, Agent::Options& options) {
  const auto refuse = [](const std::string& why) { return Error{ErrorCode::kInvalidArgument, why}; };
  if (place.store.empty() && place.data_dir.empty())
    return refuse("give --data-dir of rollgaitd, or --store postgresql://...");
  if (place.store.empty() && !place.work_dir.empty())
    return refuse("--work-dir goes with --store; the spool is in --data-dir");
  if (!place.store.empty() && place.work_dir.empty())
    return refuse("--store needs --work-dir, a directory for the spool");
  Outcome<StoreLocation> location = LocateStore(place.store, place.data_dir);
  if (!location.ok()) return location;
  location.value().connections = 1;  // one thread
  options.work_dir = location.value().is_postgres() ? place.work_dir : place.data_dir;
  options.all_agents_here = !location.value().is_postgres();
  if (location.value().is_postgres()) options.look = kLookWithNotify;
  std::error_code error;
  std::filesystem::create_directories(options.work_dir, error);
  if (error) return refuse("--work-dir " + options.work_dir + " cannot be made: " + error.message());
  return location;
}

int Main(int argc, char** argv) {
  Agent::Options options;
  CLI::App app("Works on the solves of a store, each in a process of its own.", "rollgait-agent");
  app.set_version_flag("--version", SolverBuild());
  AgentPlace place;
  app.add_option("--data-dir", place.data_dir, "Directory of rollgaitd, whose SQLite file holds the solves")
      ->check(CLI::ExistingDirectory);
  app.add_option("--store", place.store,
                 "postgresql://USER@HOST[,HOST2]/DATABASE instead of an SQLite file in --data-dir")
      ->envname(kStoreVariable);
  app.add_option("--work-dir", place.work_dir,
                 "With --store: directory of this agent's spool, made if need be; must last");
  int store_wait_s = kDefaultStoreWaitSeconds;
  app.add_option("--store-wait-s", store_wait_s, kStoreWaitHelp)->check(CLI::Range(0, 86400))->capture_default_str();
  int lease_s = 15;
  app.add_option("--lease-s", lease_s, "Seconds without a sign of life after which other agents take its solves over")
      ->check(CLI::Range(3, 3600))
      ->capture_default_str();
  auto* solver =
      app.add_option("--solver", options.solver.program, "Path of rollgait-solve; default: beside this program");
  std::string instruction_set = "auto";
  app.add_option("--instruction-set", instruction_set,
                 "Which rollgait-solve beside this program: auto, baseline or x86-64-v3")
      ->check(CLI::IsMember(InstructionSetWishes()))
      ->capture_default_str()
      ->excludes(solver);
  app.add_option("--slots", options.slots, "How many solves run at once")->check(CLI::Range(1, 1024));
  app.add_option("--memory-limit-mb", options.solver.memory_limit_mb, "Address space of a solver in MiB")
      ->check(CLI::Range(int64_t{64}, int64_t{1} << 20));
  app.add_option("--cpu-limit-s", options.solver.cpu_limit_s, "CPU time of a solver in s")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 30));
  app.add_flag("--unconfined-solver", options.solver.unconfined, kUnconfinedHelp);
  std::string metrics_listen;
  app.add_option("--metrics-listen", metrics_listen,
                 "HOST:PORT for GET /metrics (Prometheus), without encryption or authentication; default: off");
  LogFlags log;
  AddLogFlags(app, log);
  CLI11_PARSE(app, argc, argv);

  StartLogging(log.Of("rollgait-agent"));
  if (options.solver.program.empty()) {
    Outcome<SolverChoice> choice = ChooseSolver(Folder(), instruction_set);
    if (!choice.ok()) return Fail(choice.error().message);
    if (!choice.value().remark.empty()) spdlog::warn("{}", choice.value().remark);
    options.solver.program = choice.value().program;
  }
  if (access(options.solver.program.c_str(), X_OK) != 0) {
    return Fail(options.solver.program + " cannot be run: " + std::strerror(errno) + "; give --solver");
  }
  if (const auto obstacle = options.solver.unconfined ? std::nullopt : SandboxObstacle()) {
    return Fail(*obstacle + "; --unconfined-solver runs solves without it");
  }
  options.stop_fd = CatchStopSignals();
  if (options.stop_fd < 0) return Fail(std::string("cannot catch signals: ") + std::strerror(errno));
  options.lifeline_fd = Lifeline();

  const Outcome<StoreLocation> location = Locate(place, options);
  if (!location.ok()) return Fail(location.error().message);
  options.lease = std::chrono::seconds(lease_s);
  const Outcome<std::string> fingerprint = Sha256HexOfFile(options.solver.program);
  if (!fingerprint.ok()) return Fail("the solver: " + fingerprint.error().message);
  options.solver_fingerprint = fingerprint.value();

  const SystemClock clock;
  bool stopped = false;
  Outcome<std::unique_ptr<SqlStore>> store =
      AwaitStore(location.value(), clock, std::chrono::seconds(store_wait_s), [&](std::chrono::milliseconds time) {
        pollfd stop{options.stop_fd, POLLIN, 0};
        stopped = poll(&stop, 1, static_cast<int>(time.count())) > 0;
        return !stopped;
      });
  if (stopped) return 0;
  if (!store.ok()) return Fail(store.error().message);
  Outcome<std::unique_ptr<HintChannel>> hints = OpenHints(location.value(), options.work_dir, HintRole::kAgent);
  if (!hints.ok()) return Fail(hints.error().message);
  Metrics metrics("rollgait-agent", RollgaitVersion(), SolverBuild());
  MeasuredStore measured_store(*store.value(), metrics);
  Outcome<std::unique_ptr<Agent>> agent = Agent::Create(options, {measured_store, *hints.value(), clock});
  if (!agent.ok()) return Fail(agent.error().message);
  if (!metrics_listen.empty()) {
    const Outcome<std::string> address = metrics.Listen(metrics_listen);
    if (!address.ok()) return Fail(address.error().message);
    LogEvent(spdlog::level::info, "metrics.served", {{"address", address.value()}});
  }
  LogEvent(spdlog::level::info, "agent.started",
           {{"owner", agent.value()->owner()}, {"slots", options.slots}, {"store", location.value().Name()}});
  agent.value()->Run();
  LogEvent(spdlog::level::info, "agent.stopped", {{"owner", agent.value()->owner()}});
  return 0;
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
