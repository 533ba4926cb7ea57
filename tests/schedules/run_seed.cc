#include "tests/schedules/run_seed.h"

#include <cstdio>

namespace rollgait::server {
namespace {

constexpr int64_t kMostSteps = 200'000;  // a hundred times what runs take

}  // namespace

SeedOutcome RunSeed(Laboratory& laboratory, uint64_t seed, PlantedBug bug, std::vector<std::string>* lines) {
  World world(laboratory, seed, bug);
  laboratory.Prepare(world.scheduler);
  world.scheduler.Trace(lines);
  world.Populate();
  const bool ended = world.scheduler.Run(kMostSteps);
  StoreView& view = laboratory.bed().view();
  world.model.Ended(view.Solves(), [&view](int64_t number, int64_t after) { return view.Events(number, after); });
  SeedOutcome outcome{world.model.violation(), world.scheduler.steps(), world.model.counts()};
  if (!outcome.violation && !world.complaint.empty()) outcome.violation = world.complaint;
  // Stacks of actors that still run cannot be left, so the process ends with it, but not before the seed is told.
  if (!ended)
    std::fprintf(stderr, "seed %llu does not end within %lld steps\n", static_cast<unsigned long long>(seed),
                 static_cast<long long>(kMostSteps));
  ROLLGAIT_CHECK(ended);
  return outcome;
}

}  // namespace rollgait::server
