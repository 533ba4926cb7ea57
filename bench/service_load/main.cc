// Load on a rollgaitd, judged by the acceptance table of the service: `service_load SCENARIO`, or `service_load all`.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bench/service_load/scenarios.h"

namespace rollgait::load {
namespace {

const std::vector<std::pair<std::string, Row (*)(const LoadOptions&)>>& Scenarios() {
  static const std::vector<std::pair<std::string, Row (*)(const LoadOptions&)>> all = {
      {"watch", WatchScenario},       {"results", ResultsScenario},
      {"creates", CreatesScenario},   {"first-iteration", FirstIterationScenario},
      {"overload", OverloadScenario}, {"stalled-readers", StalledReadersScenario}};
  return all;
}

// What stands between the clients and the server.
std::string Guards(const TargetOptions& target) {
  const bool started = target.address.empty();
  const bool tls = started ? !target.plain_text : !target.tls_ca.empty();
  const bool token = started ? !target.plain_text : !target.token_file.empty();
  if (tls) return token ? "TLS and token" : "TLS";
  return token ? "token" : "plain text";
}

void AddFlags(CLI::App& app, LoadOptions& options) {
  CLI::Option* const target = app.add_option(
      "--target", options.target.address,
      "HOST:PORT of a running server; default: a rollgaitd of this build in a temporary directory, with a certificate "
      "and a "
      "token of its own. Scenarios that need a server of a certain size (queue, slots) expect it to be so");
  app.add_option("--tls-ca", options.target.tls_ca, "Certificates to trust, PEM: speak TLS to --target")->needs(target);
  app.add_option("--token-file", options.target.token_file, "File whose first line is a bearer token for --target")
      ->needs(target);
  app.add_flag("--plain-text", options.target.plain_text, "Start the server without TLS and tokens; default: with both")
      ->excludes(target);
  app.add_option("--solver", options.target.solver, "Path of rollgait-solve for the server that is started");
  app.add_option("--solver-slots", options.target.solver_slots, "Solves at once; default: one a core")
      ->check(CLI::Range(1, 1024));
  app.add_option("--server-flag", options.target.flags, "Further argument of the server that is started; repeatable");
  app.add_option("--seconds", options.seconds, "Length of a measurement in s")->check(CLI::Range(1.0, 86400.0));
  app.add_option("--rate", options.rate, "Calls/s; default: what is asked")->check(CLI::Range(0.1, 1e6));
  app.add_option("--streams", options.streams, "Watches; default: what is asked")->check(CLI::Range(1, 100'000));
  app.add_option("--solves", options.solves, "Solves to watch, read or start")->check(CLI::Range(1, 10'000));
  app.add_option("--connections", options.connections, "Connections that calls are spread over")
      ->check(CLI::Range(1, 10'000));
  app.add_option("--model", options.model, "Model of the solves that are watched or started");
  app.add_flag("--idle-cores", options.idle_cores, "Do not let the cores solve meanwhile");
}

int Main(int argc, char** argv) {
  CLI::App app("Open-loop load on a rollgaitd. Exit code 0: every row met, 1: not, 2: could not measure.",
               "service_load");
  LoadOptions options;
  options.target.solver_slots = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::string name;
  std::vector<std::string> names = {"all"};
  for (const auto& [known, run] : Scenarios()) names.push_back(known);
  bool json = false;
  app.add_option("SCENARIO", name, "What to measure")->required()->check(CLI::IsMember(names));
  app.add_flag("--json", json, "One line of JSON a row, with every figure");
  AddFlags(app, options);
  CLI11_PARSE(app, argc, argv);
  bool met = true;
  for (const auto& [known, run] : Scenarios()) {
    if (name != "all" && name != known) continue;
    try {
      Row row = run(options);
      row.figures["guards"] = Guards(options.target);
      row.scenario += ", " + Guards(options.target);
      met = met && row.met;
      std::printf("%s\n", (json ? RowJson(row) : RowText(row)).c_str());
      std::fflush(stdout);
    } catch (const std::exception& exception) {
      std::fprintf(stderr, "service_load %s: %s\n", known.c_str(), exception.what());
      return 2;
    }
  }
  return met ? 0 : 1;
}

}  // namespace
}  // namespace rollgait::load

int main(int argc, char** argv) { return rollgait::load::Main(argc, argv); }
