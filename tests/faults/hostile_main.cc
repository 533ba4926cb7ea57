// The hostile tenant of rollgait_two_tenants, which starts it: a process of its own, so that the tenants share nothing
// but the server. gRPC has one thread of a process wait for the sockets of all its calls, and a thread of low priority
// would delay the other tenant's answers.
//
// Prints a line for each attack: its name, a tab, calls served, a tab, calls refused.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>

#include "tests/faults/hostile_tenant.h"

namespace rollgait::faults {
namespace {

int Main(int argc, char** argv) {
  CLI::App app("A hostile tenant.", "rollgait_hostile_tenant");
  HostileTenant::Options options;
  double seconds = 1;
  app.add_option("--to", options.address, "HOST:PORT")->required();
  app.add_option("--token", options.token_file, "File with its token")->required()->check(CLI::ExistingFile);
  app.add_option("--solve", options.solve, "A finished one of its own")->required();
  app.add_option("--only", options.only, "The one attack to make; default: all");
  app.add_option("--first-number", options.first_number, "Of what it asks for; another one in each run");
  app.add_option("--seconds", seconds, "How long")->check(CLI::Range(0.1, 600.0));
  CLI11_PARSE(app, argc, argv);
  try {
    std::ifstream(options.token_file) >> options.token;
    HostileTenant tenant(options);
    tenant.Attack(seconds);
    for (const HostileTenant::Tally& tally : tenant.tallies()) {
      std::printf("%s\t%ld\t%ld\n", tally.name.c_str(), static_cast<long>(tally.served),
                  static_cast<long>(tally.refused));
    }
    return 0;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "the hostile tenant failed: %s\n", exception.what());
    return 1;
  }
}

}  // namespace
}  // namespace rollgait::faults

int main(int argc, char** argv) { return rollgait::faults::Main(argc, argv); }
