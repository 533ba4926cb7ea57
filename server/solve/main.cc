// rollgait-solve: one gait request in, iterations and one result out. Started by rollgait-agent, or by a person with
// --spec.
#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <iterator>

#include "core/gait/optimizing_gait_solver.h"
#include "server/base/cancel_signal.h"
#include "server/base/process_limits.h"
#include "server/base/sandbox.h"
#include "server/base/solver_build.h"
#include "server/solve/local_solve.h"
#include "server/solve/worker.h"

namespace rollgait::server {
namespace {

// Beyond the wall time that the request allows itself: the solver stops there by itself, the kernel only if it does
// not.
constexpr int64_t kCpuGraceSeconds = 30;

StopFlag stop_requested;

void HandleStop(int) { stop_requested.Request(); }

void StopOn(int signal) {
  struct sigaction action {};
  action.sa_handler = HandleStop;
  sigaction(signal, &action, nullptr);
}

struct Flags {
  std::string spec_file;
  int fd = -1;
  int64_t memory_limit_mb = 4096;
  int64_t cpu_limit_s = 86400;
  bool unconfined = false;
};

int Fail(const std::string& reason) {
  std::cerr << "rollgait-solve: " << reason << "\n";
  return 1;
}

int RunWorker(const Flags& flags) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) std::signal(signal, SIG_IGN);  // its agent's to answer
  if (const auto reason = ConfineProcess()) return Fail(*reason);
  if (const auto reason = LimitMemory(flags.memory_limit_mb << 20)) return Fail(*reason);
  if (const auto reason = LimitCpuTime(flags.cpu_limit_s)) return Fail(*reason);
  std::signal(SIGPIPE, SIG_IGN);
  ReportMemoryLimitOn(flags.fd);
  if (!flags.unconfined) {
    if (const auto reason = EnterSandbox()) return Fail(*reason + "; --unconfined-solver runs solves without it");
  }
  OptimizingGaitSolver solver;
  return ServeOneRequest(flags.fd, solver, stop_requested, [&](const GaitSpec& spec) {
    StopOn(kCancelSignal);  // until now the default: a solver that has nothing to do simply ends
    const auto reason = LimitCpuTime(static_cast<int64_t>(std::ceil(spec.max_wall_time)) + kCpuGraceSeconds);
    if (reason) std::cerr << "rollgait-solve: " << *reason << "\n";
  });
}

int RunForPerson(const Flags& flags) {
  StopOn(SIGINT);
  StopOn(SIGTERM);
  std::string json;
  if (flags.spec_file == "-") {
    json.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    std::ifstream file(flags.spec_file);
    if (!file) return Fail("cannot read " + flags.spec_file);
    json.assign(std::istreambuf_iterator<char>(file), {});
  }
  OptimizingGaitSolver solver;
  return SolveLocally(json, solver, stop_requested, std::cout, std::cerr);
}

int Main(int argc, char** argv) {
  Flags flags;
  CLI::App app("Solves one gait request in this process.", "rollgait-solve");
  app.set_version_flag("--version", SolverBuild());
  auto* spec = app.add_option(
      "--spec", flags.spec_file,
      "SolveSpec as proto3 JSON, - for standard input. Result on standard output, progress on "
      "standard error. Exit code 0: solved, 2: bad request, 3: no solution, 8: an accuracy bound is missed");
  auto* fd = app.add_option("--fd", flags.fd, "For rollgait-agent: connected stream to serve one framed request on")
                 ->check(CLI::Range(3, 1 << 20));
  app.add_option("--memory-limit-mb", flags.memory_limit_mb, "With --fd: bound of the address space in MiB")
      ->check(CLI::Range(int64_t{64}, int64_t{1} << 20));
  app.add_option("--cpu-limit-s", flags.cpu_limit_s, "With --fd: bound of the CPU time in s")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 30));
  app.add_flag("--unconfined-solver", flags.unconfined, kUnconfinedHelp);
  spec->excludes(fd);
  CLI11_PARSE(app, argc, argv);
  if (flags.spec_file.empty() && flags.fd < 0) return Fail("give --spec FILE; see --help");
  if (const auto reason = EnsureOneThread(argv)) return Fail(*reason);
  return flags.fd >= 0 ? RunWorker(flags) : RunForPerson(flags);
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
