// rollgaitd: the gRPC front end. Serves requests from the store and keeps a rollgait-agent alive that works on them.
#include <fcntl.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>

#include "server/access/access_store.h"
#include "server/access/gatekeeper.h"
#include "server/access_main.h"
#include "server/backup_main.h"
#include "server/base/clock.h"
#include "server/base/data_dir.h"
#include "server/base/digest.h"
#include "server/base/end_signals.h"
#include "server/base/file_lock.h"
#include "server/base/listen_address.h"
#include "server/base/log_flags.h"
#include "server/base/logging.h"
#include "server/base/memory_limit.h"
#include "server/base/memory_return.h"
#include "server/base/metrics.h"
#include "server/base/notify.h"
#include "server/base/sandbox.h"
#include "server/base/solver_build.h"
#include "server/base/solver_choice.h"
#include "server/base/supervisor.h"
#include "server/listen_main.h"
#include "server/rpc/grpc_log.h"
#include "server/rpc/rpc_server.h"
#include "server/service/core_knowledge.h"
#include "server/service/service_metrics.h"
#include "server/service/solve_service.h"
#include "server/service/warm_start_search.h"
#include "server/service/watch_hub.h"
#include "server/storage_main.h"
#include "server/store/measured_store.h"
#include "server/store/open_store.h"
#include "server/store/retention_task.h"

namespace rollgait::server {
namespace {

// What a client may take while the server ends, and its agent; together they end within 30 s of SIGTERM.
constexpr std::chrono::milliseconds kCallGrace{5'000};
constexpr std::chrono::milliseconds kAgentGrace{10'000};

struct Flags {
  std::string data_dir, store;
  int store_wait_s = kDefaultStoreWaitSeconds;
  StorageFlags storage;
  ListenFlags listen;
  AccessFlags access;
  int solver_slots = -1;  // -1: not said
  int64_t solver_memory_mb = 4096;
  int simulation_slots = 2;
  std::string agent, solver, simulator;
  std::string instruction_set = "auto";
  int max_queued = 1000;
  double heartbeat_interval_s = 10;
  bool no_result_reuse = false;
  bool unconfined_solver = false;
  LogFlags log;
  std::string metrics_listen, agent_metrics_listen;
};

// Where this program lies, and others beside it.
std::string Folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path().string();
}
std::string Sibling(const std::string& name) { return Folder() + "/" + name; }

void AddFlags(CLI::App& app, Flags& flags) {
  app.add_option("--data-dir", flags.data_dir, "Directory of the store; made if need be")->required();
  app.add_option(
         "--store", flags.store,
         "postgresql://USER@HOST[,HOST2]/DATABASE instead of an SQLite file in --data-dir; agents may be elsewhere")
      ->envname(kStoreVariable);
  app.add_option("--store-wait-s", flags.store_wait_s, kStoreWaitHelp)
      ->check(CLI::Range(0, 86400))
      ->capture_default_str();
  AddListenFlags(app, flags.listen);
  AddAccessFlags(app, flags.access);
  app.add_option(
         "--solver-slots", flags.solver_slots,
         "Solves that run at once in an agent of this server's own, 0: no agent; default: one a core, 0 with --store")
      ->check(CLI::Range(0, 1024));
  app.add_option("--solver-memory-mb", flags.solver_memory_mb,
                 "MiB of address space of a solver of this server's own agent")
      ->check(CLI::Range(int64_t{64}, int64_t{1} << 20))
      ->capture_default_str();
  app.add_option("--agent", flags.agent, "Path of rollgait-agent; default: beside this program");
  auto* solver = app.add_option("--solver", flags.solver, "Path of rollgait-solve; default: beside this program");
  app.add_option("--instruction-set", flags.instruction_set,
                 "Which rollgait-solve beside this program: auto, baseline or x86-64-v3")
      ->check(CLI::IsMember(InstructionSetWishes()))
      ->capture_default_str()
      ->excludes(solver);
  app.add_option("--simulator", flags.simulator, "Path of rollgait-simulate; default: beside this program");
  app.add_option("--simulation-slots", flags.simulation_slots, "Simulations that run at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--max-queued", flags.max_queued, "Solves that may wait; more are refused with RESOURCE_EXHAUSTED")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--heartbeat-interval", flags.heartbeat_interval_s, "Seconds between heartbeats of a silent stream")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_flag("--no-result-reuse", flags.no_result_reuse, "Solve every request, also one that was answered before");
  app.add_flag("--unconfined-solver", flags.unconfined_solver, kUnconfinedHelp);
  app.add_option("--metrics-listen", flags.metrics_listen,
                 "HOST:PORT for GET /metrics (Prometheus), without encryption or authentication; default: off");
  app.add_option("--agent-metrics-listen", flags.agent_metrics_listen,
                 "The same for the agent that this server starts");
  AddLogFlags(app, flags.log);
  app.set_version_flag("--version", SolverBuild());
}

int Fail(const std::string& reason) {
  spdlog::critical("{}", reason);
  return 1;
}

// As many connections as the system allows.
void RaiseDescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) spdlog::warn("the limit of open files stays as it was");
}

Outcome<FileLock> TakeDataDir(const DataDir& data_dir) {
  std::error_code error;
  const bool is_new = !std::filesystem::exists(data_dir.path, error);
  std::filesystem::create_directories(data_dir.AgentsDir(), error);
  if (error) {
    return Error{ErrorCode::kUnavailable, "cannot make " + data_dir.AgentsDir() + ": " + error.message()};
  }
  if (is_new) std::filesystem::permissions(data_dir.path, std::filesystem::perms::owner_all, error);
  Outcome<std::optional<FileLock>> lock = FileLock::TryAcquire(data_dir.ServerLock());
  if (!lock.ok()) return lock.error();
  if (!lock.value().has_value()) {
    return Error{ErrorCode::kUnavailable,
                 "another rollgaitd serves --data-dir " + data_dir.path + "; stop it or use another directory"};
  }
  return *std::move(lock.value());
}

int SolverSlots(const Flags& flags, const StoreLocation& location) {
  if (flags.solver_slots >= 0) return flags.solver_slots;
  return location.is_postgres() ? 0 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// The agent finds a PostgreSQL URL in its environment: its command line is for everybody to read.
Supervisor::Options AgentCommand(const Flags& flags, const std::string& solver, const std::string& directory,
                                 int slots) {
  Supervisor::Options options;
  options.name = "rollgait-agent";
  options.arguments = {flags.agent,
                       flags.store.empty() ? "--data-dir" : "--work-dir",
                       directory,
                       "--slots",
                       std::to_string(slots),
                       "--memory-limit-mb",
                       std::to_string(flags.solver_memory_mb),
                       "--solver",
                       solver,
                       "--log-format",
                       flags.log.format,
                       "--log-level",
                       flags.log.level};
  if (!flags.agent_metrics_listen.empty()) {
    options.arguments.insert(options.arguments.end(), {"--metrics-listen", flags.agent_metrics_listen});
  }
  if (flags.unconfined_solver) options.arguments.push_back("--unconfined-solver");
  return options;
}

// Solvers and simulations that all take what they may are more than there is: then the kernel chooses whom to kill.
void WarnOfMemory(const Flags& flags, int slots) {
  const int64_t simulations = flags.simulation_slots * SimulationHostOptions().memory_limit_mb;
  const int64_t most = slots * flags.solver_memory_mb + simulations, limit = MemoryLimit() >> 20;
  if (most <= limit) return;
  LogEvent(spdlog::level::warn, "memory.promised",
           {{"promised_mb", most}, {"limit_mb", limit}, {"flags", "--solver-slots, --solver-memory-mb"}});
}

// The program that solves, and the name of its build.
Outcome<SolverChoice> SolverOf(const Flags& flags) {
  if (!flags.solver.empty()) return SolverChoice{flags.solver, InstructionSet::kBaseline, ""};
  Outcome<SolverChoice> choice = ChooseSolver(Folder(), flags.instruction_set);
  if (choice.ok() && !choice.value().remark.empty()) spdlog::warn("{}", choice.value().remark);
  return choice;
}

// Why metrics cannot be served, if so.
std::optional<std::string> ServeMetrics(const Flags& flags, Metrics& metrics) {
  if (flags.metrics_listen.empty()) return std::nullopt;
  const Outcome<std::string> address = metrics.Listen(flags.metrics_listen);
  if (!address.ok()) return address.error().message;
  LogEvent(spdlog::level::info, "metrics.served", {{"address", address.value()}});
  return std::nullopt;
}

int Serve(const Flags& flags, const sigset_t& end_signals) {
  const Outcome<SolverChoice> solver = SolverOf(flags);
  if (!solver.ok()) return Fail(solver.error().message);
  const DataDir data_dir{std::filesystem::absolute(flags.data_dir).lexically_normal().string()};
  const Outcome<FileLock> lock = TakeDataDir(data_dir);
  if (!lock.ok()) return Fail(lock.error().message);
  const Outcome<std::string> fingerprint = Sha256HexOfFile(solver.value().program);
  if (!fingerprint.ok()) return Fail("the solver: " + fingerprint.error().message);
  const SystemClock clock;
  Outcome<StoreLocation> location = LocateStore(flags.store, data_dir.path);
  if (!location.ok()) return Fail(location.error().message);
  location.value().reserve_bytes = flags.storage.reserve_mb << 20;
  if (location.value().is_postgres()) setenv(kStoreVariable, flags.store.c_str(), 1);
  const int solver_slots = SolverSlots(flags, location.value());
  bool stopped = false;
  const auto store = AwaitStore(location.value(), clock, std::chrono::seconds(flags.store_wait_s),
                                [&](std::chrono::milliseconds time) {
                                  const timespec limit{time.count() / 1000, time.count() % 1000 * 1'000'000};
                                  stopped = sigtimedwait(&end_signals, nullptr, &limit) > 0;
                                  return !stopped;
                                });
  if (stopped) return 0;
  if (!store.ok()) return Fail(store.error().message);
  Metrics metrics("rollgaitd", RollgaitVersion(), SolverBuild(solver.value().set));
  MeasuredStore measured_store(*store.value(), metrics);
  const Outcome<int> placed = PlaceOldSolves(measured_store);
  if (!placed.ok()) return Fail(placed.error().message);
  if (placed.value() > 0) LogEvent(spdlog::level::info, "store.indexed", {{"solves", placed.value()}});
  const auto hints = OpenHints(location.value(), data_dir.path, HintRole::kServer);
  if (!hints.ok()) return Fail(hints.error().message);
  WatchHub hub(measured_store, *hints.value(),
               std::chrono::milliseconds(static_cast<int64_t>(1000 * flags.heartbeat_interval_s)),
               IterateFiles(data_dir.IteratesDir()));
  metrics.Collect(std::make_shared<ServiceMetrics>(measured_store, hub, clock, solver_slots));
  ServiceOptions options;
  options.version = RollgaitVersion();
  options.solver_build = SolverBuild(solver.value().set);
  options.solver_fingerprint = fingerprint.value();
  options.solver_slots = solver_slots;
  options.store_name = location.value().is_postgres() ? "postgresql" : "sqlite";
  options.store_disk = RoomOf(location.value());
  options.max_queued = flags.max_queued;
  options.reuse_results = !flags.no_result_reuse;
  SolveService service(measured_store, *store.value(), MakeCoreKnowledge(), options, [&](const std::string& id) {
    hints.value()->Send(id);
    hub.Changed(id);
  });
  AccessStore access(store.value()->database(), clock);
  Gatekeeper::Options gate;
  gate.require_identity = flags.access.asks_who_calls();
  gate.answers = flags.access.answers;
  gate.limits = flags.access.TenantDefaults(flags.max_queued, flags.simulation_slots);
  Gatekeeper gatekeeper(gate, &access, &clock);
  RpcOptions rpc_options;
  rpc_options.listen = flags.listen.address;
  rpc_options.behind_door = flags.listen.behind_door;
  rpc_options.tls = flags.access.tls;
  rpc_options.certificate_tenant = flags.access.certificate_tenant;
  rpc_options.connections = flags.access.connections;
  rpc_options.admin_directory = data_dir.path;
  rpc_options.discovery = !gate.require_identity;
  rpc_options.simulation.program = flags.simulator;
  rpc_options.simulation.slots = flags.simulation_slots;
  rpc_options.simulation.unconfined = flags.unconfined_solver;
  rpc_options.metrics = &metrics;
  const auto server = RpcServer::Start(rpc_options, service, hub, gatekeeper);
  if (!server.ok()) return Fail(server.error().message);
  if (const auto problem = ServeMetrics(flags, metrics)) return Fail(*problem);
  std::unique_ptr<Supervisor> agent;
  WarnOfMemory(flags, solver_slots);
  if (solver_slots > 0) {
    auto started = Supervisor::Start(AgentCommand(flags, solver.value().program, data_dir.path, solver_slots));
    if (!started.ok()) return Fail(started.error().message);
    agent = std::move(started).value();
  }
  spdlog::info("serving {} on {}, {} slots of {}", location.value().Name(), server.value()->address(), solver_slots,
               solver.value().program);
  std::printf("rollgaitd listening on %s\n", server.value()->address().c_str());
  std::fflush(stdout);

  const MemoryReturn memory_return;
  const RetentionTask retention(measured_store, flags.storage.Retention(), std::chrono::minutes(1), clock);

  int received = 0;
  sigwait(&end_signals, &received);
  spdlog::info("signal {}: stopping", received);
  server.value()->Stop(kCallGrace);
  if (agent != nullptr) agent->Stop(kAgentGrace);
  spdlog::info("stopped");
  return 0;
}

int Main(int argc, char** argv) {
  Flags flags;
  if (const std::optional<int> code = RunAccessCommand(argc, argv)) return *code;
  if (const std::optional<int> code = RunBackupCommand(argc, argv)) return *code;
  CLI::App app("Optimal gaits over gRPC. For its store: rollgaitd token|tenant|audit|backup|restore --help.",
               "rollgaitd");
  AddFlags(app, flags);
  AddStorageFlags(app, flags.storage);
  CLI11_PARSE(app, argc, argv);
  const sigset_t end_signals = BlockEndSignals();
  StartLogging(flags.log.Of("rollgaitd"));
  LogWhatGrpcSays();
  if (flags.agent.empty()) flags.agent = Sibling("rollgait-agent");
  if (flags.simulator.empty()) flags.simulator = Sibling("rollgait-simulate");
  if (const auto obstacle = ListenObstacle(flags.listen, flags.access)) return Fail(*obstacle);
  const bool is_reached = flags.listen.behind_door || !IsLoopback(flags.listen.address);
  if (is_reached && !flags.access.asks_who_calls() && flags.access.tls.client_ca.empty()) {
    spdlog::warn("everyone who reaches {} may use this server: give --require-token or --tls-client-ca",
                 flags.listen.address);
  }
  if (const auto obstacle = flags.unconfined_solver ? std::nullopt : SandboxObstacle()) {
    return Fail(*obstacle + "; --unconfined-solver runs solves and simulations without it");
  }
  umask(0077);  // requests and results are the owner's
  RaiseDescriptorLimit();
  return Serve(flags, end_signals);
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
