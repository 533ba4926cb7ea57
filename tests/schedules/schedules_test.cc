// The promises of agents, server and store under a few thousand schedules; and that schedules find what breaks them.
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include "tests/schedules/run_seed.h"

namespace rollgait::server {
namespace {

Laboratory& Lab() {
  static Laboratory laboratory(MakeSqliteBed());
  spdlog::set_level(spdlog::level::off);
  return laboratory;
}

TEST(SchedulesTest, PromisesAreKeptByPostgresToo) {
  Lab();  // no lines of the log
  Laboratory laboratory(MakePostgresBed());
  for (uint64_t seed = 1; seed <= 25; ++seed) {
    const SeedOutcome outcome = RunSeed(laboratory, seed, PlantedBug::kNone, nullptr);
    ASSERT_FALSE(outcome.violation) << "seed " << seed << ": " << *outcome.violation;
  }
}

// The first of so many seeds that breaks a promise; 0: none.
uint64_t FirstViolation(PlantedBug bug, uint64_t most) {
  for (uint64_t seed = 1; seed <= most; ++seed) {
    if (RunSeed(Lab(), seed, bug, nullptr).violation) return seed;
  }
  return 0;
}

TEST(SchedulesTest, PromisesAreKeptAndEveryKindOfThingHappens) {
  std::map<std::string, int64_t> counts;
  for (uint64_t seed = 1; seed <= 1500; ++seed) {
    const SeedOutcome outcome = RunSeed(Lab(), seed, PlantedBug::kNone, nullptr);
    ASSERT_FALSE(outcome.violation) << "rollgait_schedules --seed " << seed << " prints it: " << *outcome.violation;
    for (const auto& [what, count] : outcome.counts) counts[what] += count;
  }
  for (const char* what :
       {"cancelled in the queue", "cancelled while they ran", "claims while another tenant waits", "deleted",
        "events delivered", "failures", "further claims", "given back", "removed by retention", "results",
        "solves that a held result answers", "solves that an equal one answers", "taken after a lease expired",
        "taken from a dead agent", "writes refused, as the lease is lost"}) {
    EXPECT_GE(counts[what], 30) << what;
  }
}

TEST(SchedulesTest, ALeaseWithoutAnEpochIsFound) {
  EXPECT_NE(FirstViolation(PlantedBug::kLeaseWithoutEpoch, 10'000), 0u);
}

TEST(SchedulesTest, AnEventThatIsWrittenAfterTheCommitIsFound) {
  EXPECT_NE(FirstViolation(PlantedBug::kEventAfterCommit, 10'000), 0u);
}

TEST(SchedulesTest, ARetryThatForgetsItsRequestIdIsFound) {
  EXPECT_NE(FirstViolation(PlantedBug::kRetryWithoutRequestId, 10'000), 0u);
}

TEST(SchedulesTest, AQueueWithoutTurnsOrPrioritiesIsFound) {
  EXPECT_NE(FirstViolation(PlantedBug::kOldestFirst, 10'000), 0u);
  EXPECT_NE(FirstViolation(PlantedBug::kOneQueue, 10'000), 0u) << "with priorities, but no turns";
}

TEST(SchedulesTest, ASeedGivesTheSameScheduleWhateverRanBefore) {
  for (const uint64_t seed : {7u, 336u}) {
    std::vector<std::string> first, again, other;
    RunSeed(Lab(), seed, PlantedBug::kNone, &first);
    RunSeed(Lab(), seed + 1, PlantedBug::kNone, &other);
    RunSeed(Lab(), seed, PlantedBug::kNone, &again);
    EXPECT_GT(first.size(), 50u);
    EXPECT_EQ(first, again);
    EXPECT_NE(first, other);
  }
}

}  // namespace
}  // namespace rollgait::server
