#include "server/base/clock.h"

#include <gtest/gtest.h>

#include <ctime>

namespace rollgait::server {
namespace {

TEST(SystemClockTest, TellsTheTimesOfTheMachine) {
  const SystemClock clock;
  const int64_t first = clock.BootNanos();
  EXPECT_GE(clock.BootNanos(), first);
  // Time since boot is less than time since 1970 by decades.
  EXPECT_LT(first / 1000, clock.WallMicros());
  EXPECT_NEAR(static_cast<double>(clock.WallMicros()) / 1e6, static_cast<double>(time(nullptr)), 5.0);
  EXPECT_EQ(clock.BootId().size(), 36u);  // a UUID
  EXPECT_EQ(clock.BootId(), SystemClock().BootId());
}

}  // namespace
}  // namespace rollgait::server
