#include "server/base/settled_clock.h"

#include <gtest/gtest.h>

#include "tests/server/store/fake_clock.h"

namespace rollgait::server {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

TEST(SettledClockTest, BelievesAClockThatKeptPaceForLongEnough) {
  FakeClock clock;
  SettledClock settled(clock, hours(1));
  EXPECT_FALSE(settled.Look());
  clock.Advance(minutes(59));
  EXPECT_FALSE(settled.Look());
  clock.Advance(minutes(1));
  EXPECT_TRUE(settled.Look());
  clock.JumpWall(seconds(9));  // a correction
  EXPECT_TRUE(settled.Look());
}

TEST(SettledClockTest, EveryJumpStartsTheTimeAgain) {
  FakeClock clock;
  SettledClock settled(clock, hours(1));
  for (const seconds jump : {seconds(hours(400 * 24)), seconds(-hours(400 * 24)), seconds(11)}) {
    clock.Advance(hours(2));
    EXPECT_TRUE(settled.Look());
    clock.JumpWall(jump);
    EXPECT_FALSE(settled.Look());
    clock.Advance(minutes(59));
    EXPECT_FALSE(settled.Look());
  }
}

}  // namespace
}  // namespace rollgait::server
