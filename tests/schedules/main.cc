// Runs agents, server, clients and store under a seeded scheduler; see docs/explanation/schedules.md.
#include <spdlog/spdlog.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "tests/schedules/run_seed.h"

namespace rollgait::server {
namespace {

struct Wish {
  uint64_t first = 1;
  int64_t count = 1000;
  int jobs = 1;
  std::string store = "sqlite";
  PlantedBug bug = PlantedBug::kNone;
  std::optional<uint64_t> seed;
};

constexpr int kMostShown = 5;

std::unique_ptr<StoreBed> MakeBed(const Wish& wish) {
  return wish.store == "postgres" ? MakePostgresBed() : MakeSqliteBed();
}

// Prints the whole schedule. 1: it breaks a promise.
int ShowOne(const Wish& wish) {
  Laboratory laboratory(MakeBed(wish));
  std::vector<std::string> lines;
  const SeedOutcome outcome = RunSeed(laboratory, *wish.seed, wish.bug, &lines);
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  std::printf("seed %llu: %s\n", static_cast<unsigned long long>(*wish.seed),
              outcome.violation ? outcome.violation->c_str() : "all promises kept");
  return outcome.violation ? 1 : 0;
}

// Every jobs-th seed from the first one on. 1: one of them breaks a promise.
int RunPart(const Wish& wish, int part) {
  Laboratory laboratory(MakeBed(wish));
  int64_t seeds = 0, violations = 0;
  std::map<std::string, int64_t> counts;
  const auto start = std::chrono::steady_clock::now();
  for (int64_t i = part; i < wish.count; i += wish.jobs) {
    const uint64_t seed = wish.first + static_cast<uint64_t>(i);
    const SeedOutcome outcome = RunSeed(laboratory, seed, wish.bug, nullptr);
    ++seeds;
    counts["steps"] += outcome.steps;
    for (const auto& [what, count] : outcome.counts) counts[what] += count;
    if (!outcome.violation || ++violations > kMostShown) continue;
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), outcome.violation->c_str());
    std::fflush(stdout);
  }
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string text = "job " + std::to_string(part) + ": " + std::to_string(seeds) + " seeds, " +
                     std::to_string(violations) + " violations, " +
                     std::to_string(std::llround(static_cast<double>(seeds) / taken)) + " seeds/s; in 1000 seeds:\n";
  for (const auto& [what, count] : counts) {
    text += "  " + std::to_string(1000 * count / seeds) + " " + what + "\n";
  }
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
  return violations > 0 ? 1 : 0;
}

int RunAll(const Wish& wish) {
  std::vector<pid_t> children;
  for (int part = 1; part < wish.jobs; ++part) {
    const pid_t child = fork();
    if (child == 0) _exit(RunPart(wish, part));
    children.push_back(child);
  }
  int verdict = RunPart(wish, 0);
  for (const pid_t child : children) {
    int status = 0;
    if (waitpid(child, &status, 0) != child || status != 0) verdict = 1;
  }
  return verdict;
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) {
  using rollgait::server::PlantedBug;
  rollgait::server::Wish wish;
  CLI::App app("Runs agents, server, clients and store under a seeded scheduler with faults, and checks what they do");
  app.add_option("--seeds", wish.count, "how many schedules")->check(CLI::PositiveNumber);
  app.add_option("--first", wish.first, "the seed of the first one");
  app.add_option("--jobs", wish.jobs, "processes")->check(CLI::Range(1, 64));
  app.add_option("--store", wish.store)->check(CLI::IsMember({"sqlite", "postgres"}));
  app.add_option("--seed", wish.seed, "runs this schedule alone and prints it");
  const std::map<std::string, PlantedBug> bugs = {{"none", PlantedBug::kNone},
                                                  {"lease-without-epoch", PlantedBug::kLeaseWithoutEpoch},
                                                  {"event-after-commit", PlantedBug::kEventAfterCommit},
                                                  {"retry-without-request-id", PlantedBug::kRetryWithoutRequestId},
                                                  {"oldest-first", PlantedBug::kOldestFirst},
                                                  {"one-queue", PlantedBug::kOneQueue}};
  app.add_option("--bug", wish.bug, "a mistake to plant")->transform(CLI::CheckedTransformer(bugs));
  CLI11_PARSE(app, argc, argv);
  spdlog::set_level(spdlog::level::off);
  return wish.seed ? rollgait::server::ShowOne(wish) : rollgait::server::RunAll(wish);
}
