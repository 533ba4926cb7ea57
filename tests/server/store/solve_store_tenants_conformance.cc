// Whose solves they are, and who did what.
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

NewSolve Of(const std::string& tenant, const std::string& id, const std::string& request_id = "") {
  NewSolve solve{id, request_id, "spec of " + id, ""};
  solve.actor = {tenant, "token-" + tenant, "ipv4:127.0.0.1"};
  return solve;
}

std::vector<std::string> Actions(const std::vector<AuditRow>& rows) {
  std::vector<std::string> actions;
  for (const AuditRow& row : rows) actions.push_back(row.action + " " + row.solve + " " + row.outcome);
  return actions;
}

TEST_P(SolveStoreConformance, ASolveBelongsToTheTenantThatMadeIt) {
  StoreBench bench(GetParam());
  EXPECT_EQ(bench.store().Create(Of("red", "a")).value().record.tenant, "red");
  ASSERT_TRUE(bench.store().Create(Of("blue", "b")).ok());
  ASSERT_TRUE(bench.store().Create(Of("red", "c")).ok());
  EXPECT_EQ(bench.Get("b").tenant, "blue");
  ListQuery query{1, "", std::nullopt, "red"};
  const SolvePage first = bench.store().List(query).value();
  ASSERT_EQ(first.records.size(), 1u);
  EXPECT_EQ(first.records[0].id, "c");
  query.page_token = first.next_page_token;
  const SolvePage second = bench.store().List(query).value();
  ASSERT_EQ(second.records.size(), 1u);
  EXPECT_EQ(second.records[0].id, "a");
  EXPECT_EQ(second.next_page_token, "");
  query.tenant = "blue";
  EXPECT_EQ(bench.store().List(query).error().code, ErrorCode::kInvalidArgument) << "the token is of another tenant";
  EXPECT_EQ(bench.store().List({10, "", SolveState::kQueued, "blue"}).value().records.size(), 1u);
  EXPECT_EQ(bench.store().List({10, "", SolveState::kRunning, "blue"}).value().records.size(), 0u);
  EXPECT_EQ(bench.store().List({10, "", std::nullopt}).value().records.size(), 3u);
  EXPECT_EQ(bench.store().Counts("red").value().queued, 2);
  EXPECT_EQ(bench.store().Counts("nobody").value().queued, 0);
  EXPECT_EQ(bench.store().Counts("nobody").value().oldest_queued_us, 0);
  EXPECT_EQ(bench.store().Counts().value().queued, 3);
  EXPECT_EQ(bench.store().Counts().value().oldest_queued_us, bench.clock().WallMicros());
}

TEST_P(SolveStoreConformance, RequestIdsOfTenantsAreApart) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.store().Create(Of("red", "a", "same")).value().created);
  EXPECT_TRUE(bench.store().Create(Of("blue", "b", "same")).value().created);
  NewSolve retry = Of("red", "c", "same");
  retry.spec = "spec of a";
  EXPECT_EQ(bench.store().Create(retry).value().record.id, "a");
}

TEST_P(SolveStoreConformance, ATenantsQueueHasALimitOfItsOwn) {
  StoreBench bench(GetParam());
  NewSolve solve = Of("red", "a");
  solve.max_queued_tenant = 1;
  ASSERT_TRUE(bench.store().Create(solve).ok());
  solve.id = "b";
  const auto refused = bench.store().Create(solve);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kResourceExhausted);
  EXPECT_NE(refused.error().message.find("red"), std::string::npos);
  EXPECT_TRUE(refused.error().retry_after.has_value());
  EXPECT_TRUE(bench.store().Create(Of("blue", "c")).ok());
}

TEST_P(SolveStoreConformance, ATenantsStorageHasALimit) {
  StoreBench bench(GetParam());
  const auto add = [&](const std::string& tenant, const std::string& id, const std::string& request_id = "") {
    NewSolve solve = Of(tenant, id, request_id);
    solve.spec = std::string(1000, 's');
    solve.max_bytes_tenant = 4900;
    return bench.store().Create(solve);
  };
  ASSERT_TRUE(add("red", "a", "known").ok());
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, std::string(3500, 'r'), "", true}).ok());
  bench.Restart();  // sums are asked for again
  const auto refused = add("red", "b");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kResourceExhausted);
  EXPECT_NE(refused.error().message.find("bytes, this one would add 1000 and the limit is 4900; delete some"),
            std::string::npos)
      << refused.error().message;
  EXPECT_EQ(refused.error().quota->subject, "tenant:red");
  EXPECT_FALSE(add("red", "c", "known").value().created) << "a retry takes nothing";
  EXPECT_TRUE(add("blue", "d").ok()) << "others have their own";
  ASSERT_TRUE(bench.store().Delete("a").ok());
  EXPECT_TRUE(add("red", "e").ok()) << "room at once";
  EXPECT_TRUE(add("red", "f").ok());
  EXPECT_TRUE(add("red", "g").ok());
  EXPECT_TRUE(add("red", "h").ok());
  EXPECT_FALSE(add("red", "i").ok()) << "what was made since the last sum counts";
}

TEST_P(SolveStoreConformance, FingerprintAndTraceAreKept) {
  StoreBench bench(GetParam());
  NewSolve solve{"a", "", "s", ""};
  solve.solver_fingerprint = "f00d";
  solve.traceparent = "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01";
  ASSERT_TRUE(bench.store().Create(solve).ok());
  const ClaimedSolve claimed = bench.store().ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_EQ(claimed.record.solver_fingerprint, solve.solver_fingerprint);
  EXPECT_EQ(claimed.record.traceparent, solve.traceparent);
}

TEST_P(SolveStoreConformance, EveryChangeLeavesItsAuditRow) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.store().Create(Of("red", "a")).ok());
  ASSERT_TRUE(bench.store().Create(Of("red", "b")).ok());
  const Lease lease = bench.Claim();
  const Actor boss{"red", "boss", "unix:"};
  ASSERT_TRUE(bench.store().RequestCancel("a", boss).ok());
  ASSERT_TRUE(bench.store().RequestCancel("a", boss).ok()) << "nothing changes the second time";
  ASSERT_TRUE(bench.store().Finish(lease, {}, {SolveState::kCancelled, "", "e", false}).ok());
  ASSERT_TRUE(bench.store().RequestCancel("b", boss).ok());
  ASSERT_TRUE(bench.store().Delete("a", boss).ok());
  ASSERT_FALSE(bench.store().Delete("a", boss).ok());
  const std::vector<AuditRow> rows = bench.store().ReadAudit(0, 100).value();
  EXPECT_EQ(Actions(rows),
            (std::vector<std::string>{"create a queued", "create b queued", "cancel a running", "end a cancelled",
                                      "cancel b queued", "end b cancelled", "delete a deleted"}));
  EXPECT_EQ(rows[0].actor.token_id, "token-red");
  EXPECT_EQ(rows[0].actor.peer, "ipv4:127.0.0.1");
  EXPECT_EQ(rows[0].time_us, bench.clock().WallMicros());
  EXPECT_EQ(rows[2].actor.token_id, "boss");
  EXPECT_EQ(rows[3].actor.tenant, "red");
  EXPECT_EQ(bench.store().ReadAudit(rows[5].number, 100).value().size(), 1u);
  EXPECT_EQ(bench.store().ReadAudit(0, 2).value().size(), 2u);
}

}  // namespace
}  // namespace rollgait::server
