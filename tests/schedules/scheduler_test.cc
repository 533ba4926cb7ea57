#include "tests/schedules/scheduler.h"

#include <gtest/gtest.h>

#include <set>

namespace rollgait::server {
namespace {

// In which order two actors with three steps each take them.
std::string OrderOf(uint64_t seed) {
  std::vector<std::unique_ptr<FiberStack>> stacks;
  Scheduler scheduler(seed, stacks);
  std::string order;
  for (const char name : {'a', 'b'}) {
    scheduler.Add(std::string(1, name), [&scheduler, &order, name] {
      for (int i = 0; i < 3; ++i) {
        order += name;
        scheduler.Yield();
      }
    });
  }
  EXPECT_TRUE(scheduler.Run(100));
  return order;
}

TEST(SchedulerTest, SeedsReachEveryOrderAndEachItsOwn) {
  std::set<std::string> orders;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    orders.insert(OrderOf(seed));
    EXPECT_EQ(OrderOf(seed), OrderOf(seed));
  }
  EXPECT_EQ(orders.size(), 20u) << "of two times three steps";
}

TEST(SchedulerTest, TimePassesWhenNobodyCanGoOn) {
  std::vector<std::unique_ptr<FiberStack>> stacks;
  Scheduler scheduler(1, stacks);
  const VirtualTime start = scheduler.now();
  std::vector<VirtualTime> woken;
  const auto sleeper = scheduler.Add("sleeper", [&] {
    scheduler.Sleep(5 * kSecond);
    woken.push_back(scheduler.now() - start);
    scheduler.Freeze(5 * kSecond);
    woken.push_back(scheduler.now() - start);
  });
  scheduler.Add("waker", [&] {
    scheduler.Sleep(kSecond);
    scheduler.Wake(sleeper);
    scheduler.Sleep(kSecond);
    scheduler.Wake(sleeper);
  });
  EXPECT_TRUE(scheduler.Run(100));
  EXPECT_EQ(woken, (std::vector<VirtualTime>{kSecond, 6 * kSecond})) << "a frozen one is not woken";
}

TEST(SchedulerTest, AScheduleWithoutAnEndIsNoticed) {
  std::vector<std::unique_ptr<FiberStack>> stacks;
  Scheduler scheduler(1, stacks);
  bool stop = false;
  scheduler.Add("turner", [&] {
    while (!stop) scheduler.Yield();
  });
  EXPECT_FALSE(scheduler.Run(1000));
  stop = true;
  EXPECT_TRUE(scheduler.Run(2000)) << "so that its stack is left";
}

}  // namespace
}  // namespace rollgait::server
