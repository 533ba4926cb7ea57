// rollgait-simulate: one simulation request in, samples and events out. Started by rollgaitd.
#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "server/base/process_limits.h"
#include "server/base/sandbox.h"
#include "server/base/solver_build.h"
#include "server/simulate/simulation_worker.h"

namespace rollgait::server {
namespace {

int Fail(const std::string& reason) {
  std::cerr << "rollgait-simulate: " << reason << "\n";
  return 1;
}

int Main(int argc, char** argv) {
  int fd = -1;
  int64_t memory_limit_mb = 1024, cpu_limit_s = 600;
  bool unconfined = false;
  CLI::App app("Simulates one scene for rollgaitd.", "rollgait-simulate");
  app.set_version_flag("--version", SolverBuild());
  app.add_option("--fd", fd, "Connected stream to serve one framed request on")
      ->check(CLI::Range(3, 1 << 20))
      ->required();
  app.add_option("--memory-limit-mb", memory_limit_mb, "Bound of the address space in MiB")
      ->check(CLI::Range(int64_t{64}, int64_t{1} << 20));
  app.add_option("--cpu-limit-s", cpu_limit_s, "Bound of the CPU time in s")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 30));
  app.add_flag("--unconfined-solver", unconfined, kUnconfinedHelp);
  CLI11_PARSE(app, argc, argv);
  if (const auto reason = ConfineProcess()) return Fail(*reason);
  if (const auto reason = LimitMemory(memory_limit_mb << 20)) return Fail(*reason);
  if (const auto reason = LimitCpuTime(cpu_limit_s)) return Fail(*reason);
  std::signal(SIGPIPE, SIG_IGN);
  if (!unconfined) {
    if (const auto reason = EnterSandbox()) return Fail(*reason + "; --unconfined-solver simulates without it");
  }
  return ServeOneSimulation(fd);
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
