#include "server/access/access_store.h"

#include <gtest/gtest.h>

#include "tests/server/access/access_bench.h"

namespace rollgait::server {
namespace {

TEST(AccessStoreTest, ATokenIsStoredHashedAndFoundById) {
  AccessBench bench;
  const Token token = bench.Create("acme", kScopeRead, 3600);
  const TokenRecord found = bench.access().FindToken(token.id).value().value();
  EXPECT_EQ(found.tenant, "acme");
  EXPECT_EQ(found.scopes, unsigned{kScopeRead});
  EXPECT_EQ(found.hash, token.Hash());
  EXPECT_EQ(found.expire_time_us, bench.clock().WallMicros() + 3'600'000'000);
  EXPECT_FALSE(bench.access().FindToken("aaaaaaaaaaaaaaaa").value().has_value());
  ASSERT_EQ(bench.access().ListTokens().value().size(), 1u);
}

TEST(AccessStoreTest, RevocationStaysAsItWas) {
  AccessBench bench;
  const Token token = bench.Create("acme");
  const int64_t time = bench.access().RevokeToken(token.id).value().revoke_time_us;
  EXPECT_EQ(time, bench.clock().WallMicros());
  bench.clock().Advance(std::chrono::seconds(5));
  EXPECT_EQ(bench.access().RevokeToken(token.id).value().revoke_time_us, time);
  EXPECT_EQ(bench.access().RevokeToken("nobody").error().code, ErrorCode::kNotFound);
}

TEST(AccessStoreTest, LimitsOfATenantAreSetOneByOne) {
  AccessBench bench;
  ASSERT_TRUE(bench.access().SetTenant("acme", {5, std::nullopt, std::nullopt, 0.5}).ok());
  ASSERT_TRUE(bench.access().SetTenant("acme", {std::nullopt, 2, std::nullopt, std::nullopt}).ok());
  TenantOverrides limits = bench.access().FindTenant("acme").value();
  EXPECT_EQ(limits.max_queued, 5);
  EXPECT_EQ(limits.max_running, 2);
  EXPECT_FALSE(limits.max_watches.has_value());
  EXPECT_EQ(limits.creates_per_s, 0.5);
  ASSERT_TRUE(bench.access().SetTenant("acme", {-1, std::nullopt, std::nullopt, std::nullopt}).ok());
  EXPECT_FALSE(bench.access().FindTenant("acme").value().max_queued.has_value());
  TenantOverrides more;
  more.max_simulations = 3;
  more.weight = 4;
  more.max_storage_bytes = int64_t{5} << 30;
  ASSERT_TRUE(bench.access().SetTenant("acme", more).ok());
  limits = bench.access().FindTenant("acme").value();
  EXPECT_EQ(limits.max_simulations, 3);
  EXPECT_EQ(limits.weight, 4);
  EXPECT_EQ(limits.max_storage_bytes, int64_t{5} << 30);
  bench.Create("other");
  EXPECT_EQ(bench.access().ListTenants().value(), (std::vector<std::string>{"acme", "other"}));
}

TEST(AccessStoreTest, NamesOfTenantsAreChecked) {
  AccessBench bench;
  for (const std::string& bad :
       {std::string(), std::string(65, 'a'), std::string("a b"), std::string("a\n"), std::string("ä")}) {
    EXPECT_EQ(bench.access().CreateToken({bad, kScopeRead, 0, ""}).error().code, ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(bench.access().SetTenant(bad, {}).error().code, ErrorCode::kInvalidArgument) << bad;
  }
  EXPECT_TRUE(IsTenantName("spiffe://example.org/lab-1_a"));
}

TEST(AccessStoreTest, WhatTheCommandLineChangesIsAudited) {
  AccessBench bench;
  const Token token = bench.Create("acme");
  ASSERT_TRUE(bench.access().RevokeToken(token.id).ok());
  const std::vector<AuditRow> rows = bench.access().LastAudit(10).value();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].action, "revoke token");
  EXPECT_EQ(rows[1].action, "create token");
  EXPECT_EQ(rows[1].actor.token_id, token.id);
  EXPECT_EQ(rows[1].actor.tenant, "acme");
}

}  // namespace
}  // namespace rollgait::server
