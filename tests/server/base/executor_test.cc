#include "server/base/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

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

}  // namespace
}  // namespace rollgait::server
