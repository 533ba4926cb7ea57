#include "server/access/gatekeeper.h"

#include <gtest/gtest.h>

#include <future>

#include "tests/server/access/access_bench.h"

namespace rollgait::server {
namespace {

constexpr MethodRule kRead{"GetSolve", kScopeRead};
constexpr MethodRule kCreate{"CreateSolve", kScopeSolve, true};
constexpr MethodRule kStream{"WatchSolve", kScopeRead, false, true};

// A server that asks who calls; open streams are looked at without a pause.
class GatekeeperTest : public testing::Test {
 protected:
  static Gatekeeper::Options Strict() {
    Gatekeeper::Options options;
    options.require_identity = true;
    options.recheck = std::chrono::milliseconds(1);
    return options;
  }
  static Presented With(const std::string& token) { return {"Bearer " + token, "", "ipv4:192.0.2.1:1", ""}; }
  Outcome<std::shared_ptr<Admission>> Admit(const MethodRule& rule, const Presented& presented) {
    Outcome<std::shared_ptr<void>> place = gate_.Check(rule);
    if (!place.ok()) return place.error();
    return gate_.Admit(rule, presented, std::move(place).value());
  }
  ErrorCode Refusal(const MethodRule& rule, const Presented& presented) { return Admit(rule, presented).error().code; }

  AccessBench bench_;
  Gatekeeper gate_{Strict(), &bench_.access(), &bench_.clock()};
};

TEST_F(GatekeeperTest, ATenantHasItsShareOfSimulations) {
  TenantOverrides limits;
  limits.max_simulations = 1;
  ASSERT_TRUE(bench_.access().SetTenant("acme", limits).ok());
  const Presented acme = With(bench_.Create("acme").Text()), lab = With(bench_.Create("lab").Text());
  Outcome<std::shared_ptr<Admission>> first = Admit(RuleOf("Simulate"), acme);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(Refusal(RuleOf("FindPeriodicGait"), acme), ErrorCode::kResourceExhausted);
  EXPECT_TRUE(Admit(RuleOf("FindPeriodicGait"), lab).ok());
  first.value().reset();
  EXPECT_TRUE(Admit(RuleOf("FindPeriodicGait"), acme).ok());
}

TEST_F(GatekeeperTest, TokensOfATenantShareItsLaneOnceTheyWereAdmitted) {
  const Presented one = With(bench_.Create("acme").Text()), other = With(bench_.Create("acme").Text());
  const std::string strangers = gate_.LaneOf(With("nonsense"));
  EXPECT_EQ(gate_.LaneOf(one), strangers);
  ASSERT_TRUE(Admit(kRead, one).ok());
  ASSERT_TRUE(Admit(kRead, other).ok());
  EXPECT_EQ(gate_.LaneOf(one), "acme");
  EXPECT_EQ(gate_.LaneOf(other), "acme");
  EXPECT_EQ(gate_.LaneOf({"", "lab", "peer", ""}), "lab") << "a certificate's name";
  EXPECT_EQ(gate_.LaneOf({"", "", "peer", ""}), strangers);
  EXPECT_EQ(Gatekeeper({}).LaneOf(one), "") << "nobody is asked who calls";
}

TEST_F(GatekeeperTest, AnOpenServerTakesEveryone) {
  Gatekeeper open({});
  const auto admission = open.Admit(kCreate, {"Bearer nonsense", "", "peer", "trace"}, nullptr);
  ASSERT_TRUE(admission.ok());
  const Caller& caller = admission.value()->caller();
  EXPECT_EQ(caller.authentication, Authentication::kOff);
  EXPECT_EQ(caller.sees(), std::nullopt);
  EXPECT_EQ(caller.traceparent, "trace");
}

TEST_F(GatekeeperTest, ATokenNamesTheCaller) {
  const Token token = bench_.Create("acme", kScopeRead);
  const auto admission = Admit(kRead, With(token.Text()));
  ASSERT_TRUE(admission.ok()) << admission.error().message;
  const Caller& caller = admission.value()->caller();
  EXPECT_EQ(caller.tenant, "acme");
  EXPECT_EQ(caller.identity, token.id);
  EXPECT_EQ(caller.sees(), "acme");
  EXPECT_EQ(Refusal(kCreate, With(token.Text())), ErrorCode::kPermissionDenied);
  EXPECT_TRUE(Admit(kCreate, With(bench_.Create("acme", kScopeAdmin).Text())).ok());
}

TEST_F(GatekeeperTest, WhatIsNoValidTokenIsRefusedInTheSameWords) {
  const Token token = bench_.Create("acme");
  Token wrong = Token::Random();
  wrong.id = token.id;
  const std::string words = Admit(kRead, With("garbage")).error().message;
  for (const std::string& text : {Token::Random().Text(), wrong.Text(), std::string(), token.Text() + " "}) {
    const Error error = Admit(kRead, With(text)).error();
    EXPECT_EQ(error.code, ErrorCode::kUnauthenticated) << text;
    EXPECT_EQ(error.message, words);
  }
  EXPECT_EQ(Refusal(kRead, {}), ErrorCode::kUnauthenticated);
  EXPECT_EQ(Refusal(kRead, {token.Text(), "", "", ""}), ErrorCode::kUnauthenticated);  // without "Bearer "
  EXPECT_TRUE(Admit(kRead, {"bearer " + token.Text(), "", "", ""}).ok());
}

TEST_F(GatekeeperTest, ExpiredAndRevokedTokensAreRefusedAtOnce) {
  const Token brief = bench_.Create("acme", kScopeRead, 60), taken = bench_.Create("acme");
  EXPECT_TRUE(Admit(kRead, With(brief.Text())).ok());
  EXPECT_TRUE(Admit(kRead, With(taken.Text())).ok());
  bench_.clock().Advance(std::chrono::seconds(60));
  ASSERT_TRUE(bench_.access().RevokeToken(taken.id).ok());
  EXPECT_EQ(Refusal(kRead, With(brief.Text())), ErrorCode::kUnauthenticated);
  EXPECT_EQ(Refusal(kRead, With(taken.Text())), ErrorCode::kUnauthenticated);
}

TEST_F(GatekeeperTest, OpenStreamsEndWhenTheirTokenDoes) {
  const Token token = bench_.Create("acme"), other = bench_.Create("acme");
  const auto stream = Admit(kStream, With(token.Text())), unharmed = Admit(kStream, With(other.Text()));
  std::promise<Error> ended;
  bool other_ended = false;
  bool told = false;  // by the one watching thread only
  stream.value()->WhenWithdrawn([&](const Error& error) {
    if (!std::exchange(told, true)) ended.set_value(error);
  });
  unharmed.value()->WhenWithdrawn([&](const Error&) { other_ended = true; });
  ASSERT_TRUE(bench_.access().RevokeToken(token.id).ok());
  EXPECT_EQ(ended.get_future().get().code, ErrorCode::kUnauthenticated);
  EXPECT_FALSE(other_ended);
}

TEST_F(GatekeeperTest, ACertificateStandsForItsTenant) {
  const auto admission = Admit(kCreate, {"", "lab-1", "peer", ""});
  ASSERT_TRUE(admission.ok());
  EXPECT_EQ(admission.value()->caller().authentication, Authentication::kCertificate);
  EXPECT_EQ(admission.value()->caller().tenant, "lab-1");
  EXPECT_EQ(Refusal(kRead, {"", "not a tenant", "peer", ""}), ErrorCode::kUnauthenticated);
  // A token that is shown is what counts.
  EXPECT_EQ(Refusal(kRead, {"Bearer garbage", "lab-1", "peer", ""}), ErrorCode::kUnauthenticated);
}

TEST_F(GatekeeperTest, LimitsOfTheTenantHold) {
  ASSERT_TRUE(bench_.access().SetTenant("acme", {7, std::nullopt, 1, 0.001}).ok());
  const Token token = bench_.Create("acme");
  const auto watch = Admit(kStream, With(token.Text()));
  ASSERT_TRUE(watch.ok());
  EXPECT_EQ(watch.value()->caller().limits.max_queued, 7);
  EXPECT_EQ(Refusal(kStream, With(token.Text())), ErrorCode::kResourceExhausted);
  EXPECT_TRUE(Admit(kCreate, With(token.Text())).ok());
  EXPECT_EQ(Refusal(kCreate, With(token.Text())), ErrorCode::kResourceExhausted);
  EXPECT_TRUE(Admit(kCreate, With(bench_.Create("other").Text())).ok());
}

TEST_F(GatekeeperTest, ADrainingServerRefusesAndWaitsForWhatIsLeft) {
  auto admission = Admit(kRead, With(bench_.Create("acme").Text()));
  gate_.Drain();
  const Error refusal = gate_.Check(kRead).error();
  EXPECT_EQ(refusal.code, ErrorCode::kUnavailable);
  EXPECT_TRUE(refusal.retry_after.has_value());
  EXPECT_FALSE(gate_.WaitUntilLeft(std::chrono::milliseconds(1)));
  admission.value().reset();
  EXPECT_TRUE(gate_.WaitUntilLeft(std::chrono::minutes(1)));
}

TEST_F(GatekeeperTest, RefusalsAreAuditedButNotEachOne) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(Refusal(kRead, With("garbage")), ErrorCode::kUnauthenticated);
  const std::vector<AuditRow> rows = bench_.access().LastAudit(1000).value();
  EXPECT_GE(rows.size(), 1u);
  EXPECT_EQ(rows[0].action, "call GetSolve");
  EXPECT_EQ(rows[0].outcome, "unauthenticated");
  EXPECT_EQ(rows[0].actor.peer, "ipv4:192.0.2.1:1");
  for (const AuditRow& row : rows) EXPECT_EQ(row.detail.find("garbage"), std::string::npos);
}

}  // namespace
}  // namespace rollgait::server
