#include "server/base/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>
#include <thread>

namespace rollgait::server {
namespace {

TEST(ExecutorTest, RunsEverythingThatWasTaken) {
  std::atomic<int> runs{0};
  {
    Executor executor(4, 1000);
    for (int i = 0; i < 500; ++i) ASSERT_TRUE(executor.TryPost([&] { ++runs; }));
    executor.Post([&] { executor.Post([&] { ++runs; }); });
    executor.Stop();
    EXPECT_FALSE(executor.TryPost([&] { ++runs; }));
  }
  EXPECT_EQ(runs, 501);
}

TEST(ExecutorTest, BoundsWhatWaits) {
  Executor executor(1, 2);
  std::promise<void> started, gate;
  executor.Post([&] {
    started.set_value();
    gate.get_future().wait();
  });
  started.get_future().wait();  // the only thread is busy, nothing waits
  EXPECT_TRUE(executor.TryPost([] {}));
  EXPECT_TRUE(executor.TryPost([] {}));
  EXPECT_FALSE(executor.TryPost([] {}));
  std::atomic<bool> ran{false};
  executor.Post([&] { ran = true; });  // beyond the bound: accepted work goes on
  EXPECT_FALSE(executor.WaitIdle(std::chrono::milliseconds(0)));
  gate.set_value();
  EXPECT_TRUE(executor.WaitIdle(std::chrono::minutes(1)));
  EXPECT_TRUE(ran);
}

// Eight threads, of which tasks of one lane hold as many as it may have.
TEST(ExecutorTest, ALaneLeavesThreadsToOthers) {
  Executor executor(8, 1000);
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  std::atomic<int> inside{0}, most{0};
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(executor.TryPost("hostile", [&] {
      const int now = ++inside;
      for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
      }
      opened.wait();
      --inside;
    }));
  }
  std::promise<void> ran;
  ASSERT_TRUE(executor.TryPost("good", [&] { ran.set_value(); }));
  EXPECT_EQ(ran.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
  gate.set_value();
  EXPECT_TRUE(executor.WaitIdle(std::chrono::minutes(1)));
  EXPECT_LE(most, 6);
}

// While lanes share the threads, and a machine of few cores lets each have one.
TEST(ExecutorTest, ATaskThatIsBlockedLetsOneOfItsLaneStart) {
  Executor executor(8, 1000);
  std::promise<void> gate;
  const std::shared_future<void> opened = gate.get_future().share();
  std::atomic<int> blocked{0}, computing{0};
  ASSERT_TRUE(executor.TryPost("other", [] {}));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(executor.TryPost("a", [&] {
      {
        const Executor::Blocked once, and_not_twice;
        ++blocked;
        opened.wait();
      }
      ++computing;
    }));
  }
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (blocked < 4 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  // Half of the threads are left.
  std::promise<void> ran;
  ASSERT_TRUE(executor.TryPost("other", [&] { ran.set_value(); }));
  EXPECT_EQ(ran.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
  EXPECT_GE(blocked, 4);
  EXPECT_LE(blocked, 6);
  gate.set_value();
  EXPECT_TRUE(executor.WaitIdle(std::chrono::minutes(1)));
  EXPECT_EQ(computing, 10);
  const Executor::Blocked no_executor;
}

TEST(ExecutorTest, LanesThatWaitTakeTurns) {
  Executor executor(1, 1000);
  std::promise<void> gate;
  executor.Post([&] { gate.get_future().wait(); });
  std::string order;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(executor.TryPost("a", [&] { order += 'a'; }));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(executor.TryPost("b", [&] { order += 'b'; }));
  gate.set_value();
  ASSERT_TRUE(executor.WaitIdle(std::chrono::minutes(1)));
  EXPECT_EQ(order, "ababa");
}

TEST(ExecutorTest, ALaneHasHalfOfThePlacesToWait) {
  Executor executor(1, 4);
  std::promise<void> started, gate;
  executor.Post([&] {
    started.set_value();
    gate.get_future().wait();
  });
  started.get_future().wait();
  EXPECT_TRUE(executor.TryPost("a", [] {}));
  EXPECT_TRUE(executor.TryPost("a", [] {}));
  EXPECT_FALSE(executor.TryPost("a", [] {}));
  EXPECT_TRUE(executor.TryPost("b", [] {}));
  gate.set_value();
  EXPECT_TRUE(executor.WaitIdle(std::chrono::minutes(1)));
}

}  // namespace
}  // namespace rollgait::server
