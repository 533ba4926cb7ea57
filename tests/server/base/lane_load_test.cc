#include "server/base/lane_load.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const LaneLoad::Clock::time_point kStart{std::chrono::hours(1)};

// A lane that takes this share of a core for ten seconds, in pieces of 10 ms.
void Take(LaneLoad& load, const std::string& lane, double share) {
  for (int i = 0; i < 1000; ++i) {
    const auto took = std::chrono::nanoseconds(static_cast<int64_t>(share * 1e7));
    load.Add(lane, took, kStart + i * milliseconds(10));
  }
}
const LaneLoad::Clock::time_point kEnd = kStart + seconds(10);

TEST(LaneLoadTest, WhoTakesMuchAndMoreThanOthersIsBusy) {
  for (const double share : {0.2, 0.3, 1.0}) {
    LaneLoad load;
    for (int i = 0; i < 1000; ++i) {
      const auto now = kStart + i * milliseconds(10);
      load.Add("hostile", std::chrono::nanoseconds(static_cast<int64_t>(share * 1e7)), now);
      load.Add("good", std::chrono::microseconds(500), now);
    }
    EXPECT_EQ(load.IsBusy("hostile", kEnd), share > 0.25) << share;
    EXPECT_FALSE(load.IsBusy("good", kEnd));
    EXPECT_FALSE(load.IsBusy("unknown", kEnd));
  }
}

TEST(LaneLoadTest, AloneNobodyIsBusy) {
  LaneLoad load;
  Take(load, "only", 2);
  EXPECT_FALSE(load.IsBusy("only", kEnd));
  load.Add("other", milliseconds(1), kEnd);
  EXPECT_TRUE(load.IsBusy("only", kEnd));
}

TEST(LaneLoadTest, WhatIsPastIsForgotten) {
  LaneLoad load;
  Take(load, "hostile", 1);
  load.Add("good", milliseconds(1), kEnd);
  EXPECT_TRUE(load.IsBusy("hostile", kEnd + seconds(1)));
  EXPECT_FALSE(load.IsBusy("hostile", kEnd + seconds(4)));
}

}  // namespace
}  // namespace rollgait::server
