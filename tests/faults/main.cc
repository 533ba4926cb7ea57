// Faults on a rollgaitd under load: `rollgait_faults FAULT [--count N]` prints a row; exit code 0: survived, 1: not,
// 77: this machine cannot make the fault.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "tests/faults/faults.h"

namespace rollgait::faults {
namespace {

struct Fault {
  const char* name;
  FaultReport (*run)(const FaultOptions&);
};

constexpr Fault kFaults[] = {
    {"kill-server", KillServer},    {"stop-server", StopServer},   {"kill-agent", KillAgent},
    {"kill-solver", KillSolver},    {"freeze-agent", FreezeAgent}, {"fill-disk", FillDisk},
    {"jump-clocks", JumpClocks},    {"cut-network", CutNetwork},   {"flood-descriptors", FloodDescriptors},
    {"fail-over", FailOverPostgres}};

int Run(const Fault& fault, const FaultOptions& options) {
  try {
    const FaultReport report = fault.run(options);
    if (!report.skipped.empty()) {
      std::printf("| %s | %s | SKIPPED: %s | not done |\n", report.fault.c_str(), report.asked.c_str(),
                  report.skipped.c_str());
      return 77;
    }
    std::printf("| %s | %s | %s | %s |\n", report.fault.c_str(), report.asked.c_str(), report.measured.c_str(),
                report.good ? "met" : "NOT MET");
    return report.good ? 0 : 1;
  } catch (const std::exception& exception) {
    std::printf("| %s | | failed: %s | NOT MET |\n", fault.name, exception.what());
    return 1;
  }
}

int Main(int argc, char** argv) {
  CLI::App app("Faults under load.", "rollgait_faults");
  std::vector<std::string> names;
  for (const Fault& fault : kFaults) names.push_back(fault.name);
  std::string name;
  FaultOptions options;
  app.add_option("FAULT", name, "What happens")->required()->check(CLI::IsMember(names));
  app.add_option("--count", options.count, "How often")->check(CLI::Range(1, 100'000))->capture_default_str();
  app.add_flag("--judge-times", options.judge_times, "Fail where a time of the acceptance table is exceeded");
  app.add_option("--seed", options.seed, "Of the times between faults")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  for (const Fault& fault : kFaults) {
    if (name == fault.name) return Run(fault, options);
  }
  return 1;
}

}  // namespace
}  // namespace rollgait::faults

int main(int argc, char** argv) { return rollgait::faults::Main(argc, argv); }
