#ifndef ROLLGAIT_TESTS_SCHEDULES_RUN_SEED_H_
#define ROLLGAIT_TESTS_SCHEDULES_RUN_SEED_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/schedules/world.h"

namespace rollgait::server {

// What became of one schedule.
struct SeedOutcome {
  std::optional<std::string> violation;  // of a promise
  int64_t steps = 0;
  std::map<std::string, int64_t> counts;  // of HistoryModel
};

// Runs the schedule of a seed. The same seed gives the same schedule, whatever ran before. `lines`, unless null, gets
// what happens, a line each.
SeedOutcome RunSeed(Laboratory& laboratory, uint64_t seed, PlantedBug bug, std::vector<std::string>* lines);

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_RUN_SEED_H_
