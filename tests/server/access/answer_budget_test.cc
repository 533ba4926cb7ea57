#include "server/access/answer_budget.h"

#include <gtest/gtest.h>

#include <vector>

namespace rollgait::server {
namespace {

constexpr int64_t kMiB = 1 << 20;
constexpr AnswerLimits kLimits{.connection = 4 * kMiB, .tenant = 6 * kMiB, .all = 8 * kMiB};

class AnswerBudgetTest : public testing::Test {
 protected:
  std::unique_ptr<AnswerHold> Open(const std::string& connection, const std::string& tenant) {
    return std::move(budget_->Open(connection, tenant)).value();
  }

  const std::shared_ptr<AnswerBudget> budget_ = std::make_shared<AnswerBudget>(kLimits);
};

TEST_F(AnswerBudgetTest, AConnectionATenantAndTheServerHaveTheirLimits) {
  const auto a = Open("c1", "acme"), b = Open("c1", "acme"), c = Open("c2", "acme"), d = Open("c3", "lab");
  ASSERT_TRUE(a->Hold(3 * kMiB).ok());
  const Outcome<Done> connection = b->Hold(3 * kMiB / 2);
  ASSERT_FALSE(connection.ok());
  EXPECT_EQ(connection.error().code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(connection.error().message,
            "answers of this connection that were not read yet take 3.0 MiB, this one needs 1.5 MiB and the limit is "
            "4.0 MiB; read those first");
  EXPECT_TRUE(connection.error().retry_after.has_value());
  ASSERT_TRUE(c->Hold(2 * kMiB).ok());
  const Outcome<Done> tenant = c->Hold(7 * kMiB / 2);
  ASSERT_FALSE(tenant.ok());
  EXPECT_NE(tenant.error().message.find("of tenant \"acme\""), std::string::npos) << tenant.error().message;
  EXPECT_EQ(tenant.error().quota->subject, "tenant:acme");
  const Outcome<Done> all = d->Hold(7 * kMiB / 2);
  ASSERT_FALSE(all.ok());
  EXPECT_NE(all.error().message.find("of all clients"), std::string::npos) << all.error().message;
  EXPECT_FALSE(all.error().quota.has_value());
  EXPECT_EQ(budget_->refused(), (std::array<int64_t, 3>{1, 1, 1}));
  EXPECT_TRUE(d->Hold(2 * kMiB).ok());
}

TEST_F(AnswerBudgetTest, WhatIsReadOrRefusedIsFreeAgain) {
  {
    const auto a = Open("c", "t"), b = Open("c", "t");
    ASSERT_TRUE(a->Hold(3 * kMiB).ok());
    EXPECT_FALSE(b->Hold(3 * kMiB).ok());
    EXPECT_EQ(budget_->held(), 3 * kMiB + 2 * AnswerBudget::kEveryCall);
    EXPECT_TRUE(a->Hold(0).ok());
    EXPECT_TRUE(b->Hold(3 * kMiB).ok());
  }
  EXPECT_EQ(budget_->held(), 0);
}

TEST_F(AnswerBudgetTest, OpenCallsCountAndWhatIsOwedRefusesTheNext) {
  std::vector<std::unique_ptr<AnswerHold>> open;
  for (int64_t i = 0; i < kLimits.connection / AnswerBudget::kEveryCall; ++i) open.push_back(Open("c", "t"));
  EXPECT_FALSE(budget_->Open("c", "t").ok());
  EXPECT_EQ(budget_->held(), kLimits.connection) << "a refused call holds nothing";
  open.resize(1);
  open[0]->Owe(100 * kMiB);
  EXPECT_FALSE(budget_->Open("other", "other").ok());
  open[0]->Owe(0);
  EXPECT_TRUE(budget_->Open("other", "other").ok());
}

}  // namespace
}  // namespace rollgait::server
