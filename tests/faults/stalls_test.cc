#include "tests/faults/stalls.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace rollgait::faults {
namespace {

using std::chrono::milliseconds;

// In a process of its own, so that no shell sees the one it has started stop.
int SeesItsOwnStall() {
  const Stalls stalls;
  const Stalls::Clock::time_point start = Stalls::Clock::now();
  raise(SIGSTOP);
  const Stalls::Clock::time_point end = Stalls::Clock::now();
  const Stalls::Clock::duration stood = stalls.Between(start, end);
  EXPECT_GE(stood, milliseconds(550));
  EXPECT_LE(stood, end - start);
  const Stalls::Clock::time_point within = end - stood / 2;  // since when half of the stall is left
  EXPECT_LE(stalls.Between(within, end), end - within);
  EXPECT_GE(stalls.Between(within, end), stood / 2 - milliseconds(50));
  EXPECT_EQ(stalls.Between(start - milliseconds(500), start - milliseconds(400)), milliseconds(0));
  EXPECT_LE(stalls.RanSince(start), Stalls::Clock::now() - start - stood);
  return testing::Test::HasFailure() ? 1 : 0;
}

TEST(StallsTest, ATimeInWhichTheProcessStoodStillDoesNotCount) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(SeesItsOwnStall());
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  std::this_thread::sleep_for(milliseconds(600));
  ASSERT_EQ(kill(child, SIGCONT), 0);
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

// What a server does that keeps every core busy is no stall: its calls are late, and are told so.
TEST(StallsTest, ABusyMachineDoesNotStandStill) {
  std::atomic<bool> stop{false};
  std::vector<std::jthread> busy;
  for (unsigned i = 0; i < 4 * std::thread::hardware_concurrency(); ++i) {
    busy.emplace_back([&stop] {
      while (!stop) {
      }
    });
  }
  const Stalls stalls;
  Stalls::Clock::duration least = std::chrono::hours(1);
  for (int i = 0; i < 5 && least > milliseconds(0); ++i) {  // the machine of the test stands still at times, too
    const Stalls::Clock::time_point start = Stalls::Clock::now();
    std::this_thread::sleep_for(milliseconds(400));
    least = std::min(least, stalls.Between(start, Stalls::Clock::now()));
  }
  stop = true;
  EXPECT_EQ(least, milliseconds(0));
}

}  // namespace
}  // namespace rollgait::faults
