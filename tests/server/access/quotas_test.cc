#include "server/access/quotas.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace rollgait::server {
namespace {

TEST(QuotasTest, ABucketHoldsTwoSecondsAndFillsWithTime) {
  Quotas::Clock::time_point now{};
  Quotas quotas([&] { return now; });
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(quotas.TakeCreate("a", 5).has_value()) << i;
  const std::optional<Error> refused = quotas.TakeCreate("a", 5);
  ASSERT_TRUE(refused.has_value());
  EXPECT_EQ(refused->code, ErrorCode::kResourceExhausted);
  ASSERT_TRUE(refused->quota.has_value());
  EXPECT_EQ(refused->quota->subject, "tenant:a");
  ASSERT_TRUE(refused->retry_after.has_value());
  EXPECT_EQ(refused->retry_after->count(), 200);
  EXPECT_FALSE(quotas.TakeCreate("b", 5).has_value());  // another tenant's is another bucket
  now += *refused->retry_after;
  EXPECT_FALSE(quotas.TakeCreate("a", 5).has_value());
  EXPECT_TRUE(quotas.TakeCreate("a", 5).has_value());
  EXPECT_FALSE(quotas.TakeCreate("a", 0).has_value());  // 0: no limit
}

TEST(QuotasTest, WhatWasMadeTogetherIsWaitedForAfterwards) {
  Quotas::Clock::time_point now{};
  Quotas quotas([&] { return now; });
  ASSERT_FALSE(quotas.TakeCreate("a", 5).has_value());
  quotas.OweCreates("a", 5, 29);  // 30 of the 10 that the bucket holds
  const std::optional<Error> refused = quotas.TakeCreate("a", 5);
  ASSERT_TRUE(refused.has_value());
  EXPECT_EQ(refused->retry_after->count(), 4200);
  now += *refused->retry_after - std::chrono::milliseconds(1);
  EXPECT_TRUE(quotas.TakeCreate("a", 5).has_value());
  now += std::chrono::milliseconds(2);
  EXPECT_FALSE(quotas.TakeCreate("a", 5).has_value());
  quotas.OweCreates("b", 0, 29);  // no limit, nothing owed
  EXPECT_FALSE(quotas.TakeCreate("b", 5).has_value());
}

TEST(QuotasTest, WatchesAreGivenBack) {
  Quotas quotas;
  Outcome<std::shared_ptr<void>> first = quotas.TakeWatch("a", 2);
  ASSERT_TRUE(first.ok());
  {
    const Outcome<std::shared_ptr<void>> second = quotas.TakeWatch("a", 2);
    ASSERT_TRUE(second.ok());
    const Outcome<std::shared_ptr<void>> third = quotas.TakeWatch("a", 2);
    ASSERT_FALSE(third.ok());
    EXPECT_EQ(third.error().quota->subject, "tenant:a");
    EXPECT_TRUE(quotas.TakeWatch("b", 2).ok());
    EXPECT_EQ(quotas.watches("a"), 2);
  }
  EXPECT_EQ(quotas.watches("a"), 1);
  EXPECT_EQ(quotas.watches("b"), 0);
  EXPECT_TRUE(quotas.TakeWatch("a", 2).ok());
}

TEST(QuotasTest, SimulationsAreCountedForThemselves) {
  Quotas quotas;
  const Outcome<std::shared_ptr<void>> watch = quotas.TakeWatch("a", 1);
  Outcome<std::shared_ptr<void>> first = quotas.TakeSimulation("a", 1);
  ASSERT_TRUE(first.ok());
  const Outcome<std::shared_ptr<void>> second = quotas.TakeSimulation("a", 1);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().code, ErrorCode::kResourceExhausted);
  EXPECT_NE(second.error().message.find("1 simulations of tenant \"a\" run"), std::string::npos)
      << second.error().message;
  EXPECT_TRUE(quotas.TakeSimulation("b", 1).ok());
  first.value().reset();
  EXPECT_TRUE(quotas.TakeSimulation("a", 1).ok());
}

TEST(BackpressureTest, TooManyAtOnceAreRefused) {
  Backpressure pressure(1);
  Outcome<std::shared_ptr<void>> inside = pressure.Enter();
  ASSERT_TRUE(inside.ok());
  EXPECT_EQ(pressure.Enter().error().code, ErrorCode::kResourceExhausted);
  inside.value().reset();
  EXPECT_TRUE(pressure.Enter().ok());
}

TEST(BackpressureTest, ATenantLeavesPlacesToOthers) {
  Backpressure pressure(4);
  std::vector<std::shared_ptr<void>> held;
  for (int i = 0; i < 3; ++i) held.push_back(pressure.Enter("a").value());
  const Error refused = pressure.Enter("a").error();
  EXPECT_EQ(refused.code, ErrorCode::kResourceExhausted);
  EXPECT_NE(refused.message.find("3 calls that make work of the same tenant"), std::string::npos) << refused.message;
  EXPECT_TRUE(pressure.Enter("b").ok());
  held.pop_back();
  EXPECT_TRUE(pressure.Enter("a").ok());
}

}  // namespace
}  // namespace rollgait::server
