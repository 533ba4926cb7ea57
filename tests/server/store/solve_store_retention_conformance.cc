// What is kept, and for how long.
#include <thread>
#include <vector>

#include "server/store/retention_task.h"
#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

using std::chrono::hours;

void Finish(StoreBench& bench, const std::string& id, const std::string& result = "the result") {
  bench.Add(id);
  const Lease lease = bench.Claim();
  ASSERT_EQ(lease.solve_id, id);
  ASSERT_TRUE(bench.store().AppendEvents(lease, {IterationEvent(0), IterationEvent(1)}).ok());
  ASSERT_TRUE(bench.store().Finish(lease, {}, {SolveState::kSucceeded, result, "", true}).ok());
}

int RetainAll(StoreBench& bench, const RetentionLimits& limits) {
  int solves = 0;
  while (true) {
    const Removed removed = bench.store().Retain(limits).value();
    if (!removed.any()) return solves;
    solves += removed.solves;
  }
}

bool Held(StoreBench& bench, const std::string& id) { return bench.store().Get(id).ok(); }

TEST_P(SolveStoreConformance, SolvesAreKeptForTheirTime) {
  StoreBench bench(GetParam());
  Finish(bench, "old");
  bench.clock().Advance(hours(3));
  Finish(bench, "young");
  bench.Add("runs");
  bench.Claim();
  bench.Add("waits");
  RetentionLimits limits;
  EXPECT_EQ(RetainAll(bench, limits), 0);
  limits.solves = hours(2);
  bench.clock().Advance(hours(1));
  EXPECT_EQ(RetainAll(bench, limits), 1);
  EXPECT_FALSE(Held(bench, "old"));
  EXPECT_TRUE(Held(bench, "young"));
  bench.clock().Advance(hours(1000));
  EXPECT_EQ(RetainAll(bench, limits), 1);
  EXPECT_EQ(bench.Get("runs").state, SolveState::kRunning) << "what has not finished stays";
  EXPECT_EQ(bench.Get("waits").state, SolveState::kQueued);
  const std::vector<AuditRow> rows = bench.store().ReadAudit(0, 100).value();
  EXPECT_EQ(rows.back().action, "expire");
  EXPECT_EQ(rows.back().solve, "young");
}

TEST_P(SolveStoreConformance, TheOldestGoWhenAllTakeTooMuch) {
  StoreBench bench(GetParam());
  for (size_t i = 0; i < 4; ++i) {
    Finish(bench, Numbered("s", i), std::string(10'000, 'r'));
    bench.clock().Advance(hours(1));
  }
  RetentionLimits limits;
  limits.solve_bytes = 50'000;
  EXPECT_EQ(RetainAll(bench, limits), 0);
  limits.solve_bytes = 25'000;
  EXPECT_EQ(RetainAll(bench, limits), 2);
  EXPECT_FALSE(Held(bench, "s0"));
  EXPECT_FALSE(Held(bench, "s1"));
  EXPECT_TRUE(Held(bench, "s2"));
  EXPECT_TRUE(Held(bench, "s3"));
}

TEST_P(SolveStoreConformance, WhatOneTenantStoresRemovesNothingOfAnother) {
  StoreBench bench(GetParam());
  const auto finish = [&](const std::string& tenant, const std::string& id) {
    NewSolve solve{id, "", "spec", ""};
    solve.actor.tenant = tenant;
    ASSERT_TRUE(bench.store().Create(solve).ok());
    ASSERT_TRUE(
        bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, std::string(10'000, 'r'), "", true}).ok());
    bench.clock().Advance(hours(1));
  };
  finish("victim", "oldest");
  for (size_t i = 0; i < 4; ++i) finish("flood", Numbered("s", i));
  RetentionLimits limits;
  limits.solve_bytes = 25'000;
  EXPECT_EQ(RetainAll(bench, limits), 2);
  EXPECT_TRUE(Held(bench, "oldest"));
  EXPECT_FALSE(Held(bench, "s1"));
  EXPECT_TRUE(Held(bench, "s2"));
}

TEST_P(SolveStoreConformance, ASharedResultOutlivesTheSolveThatMadeIt) {
  StoreBench bench(GetParam());
  bench.Add("a", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  bench.clock().Advance(hours(3));
  EXPECT_TRUE(bench.Add("b", "key").from_cache);
  RetentionLimits limits;
  limits.solves = hours(2);
  EXPECT_EQ(RetainAll(bench, limits), 1);
  EXPECT_EQ(bench.Get("b").result, "the result");
}

TEST_P(SolveStoreConformance, EventLogsAreTrimmedButForTheirEnd) {
  StoreBench bench(GetParam());
  Finish(bench, "a");  // queued, running, two iterations, finished
  bench.Add("runs");
  bench.Claim();
  bench.clock().Advance(hours(3));
  RetentionLimits limits;
  limits.events = hours(2);
  EXPECT_EQ(bench.store().Retain(limits).value().event_logs, 1);
  EXPECT_FALSE(bench.store().Retain(limits).value().any());
  EXPECT_EQ(bench.Get("a").result, "the result");
  const auto refused = bench.store().ReadEvents("a", 2, 10);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfRange);
  EXPECT_NE(refused.error().message.find("the oldest event held of solves/a is 5"), std::string::npos)
      << refused.error().message;
  const EventPage rest = bench.store().ReadEvents("a", 4, 10).value();
  ASSERT_EQ(rest.events.size(), 1u);
  EXPECT_EQ(rest.events[0].kind, EventKind::kFinished);
  EXPECT_EQ(rest.events[0].sequence, 5);
  EXPECT_EQ(bench.Events("runs").size(), 2u);
}

TEST_P(SolveStoreConformance, AuditRowsAreKeptForTheirTime) {
  StoreBench bench(GetParam());
  bench.Add("a");
  bench.clock().Advance(hours(3));
  bench.Add("b");
  RetentionLimits limits;
  limits.audit = hours(2);
  EXPECT_EQ(bench.store().Retain(limits).value().audit_rows, 1);
  const std::vector<AuditRow> rows = bench.store().ReadAudit(0, 10).value();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].solve, "b");
}

TEST_P(SolveStoreConformance, ATaskKeepsTheLimits) {
  StoreBench bench(GetParam());
  Finish(bench, "a");
  bench.clock().Advance(hours(3));
  RetentionLimits limits;
  limits.solves = hours(2);
  const RetentionTask task(bench.store(), limits, std::chrono::milliseconds(10), bench.clock(), hours(0));
  bool gone = false;
  for (int tries = 0; tries < 6000 && !gone; ++tries) {
    gone = !Held(bench, "a");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(gone);
}

TEST_P(SolveStoreConformance, AClockThatJumpsRemovesNothing) {
  StoreBench bench(GetParam());
  Finish(bench, "a");
  RetentionLimits limits;
  limits.solves = hours(24 * 365);
  const RetentionTask task(bench.store(), limits, std::chrono::milliseconds(1), bench.clock());
  bench.clock().JumpWall(hours(24 * 400));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // some looks of the task
  EXPECT_TRUE(Held(bench, "a"));
  bench.clock().Advance(hours(1));  // it was no mistake: the year is over
  bool gone = false;
  for (int tries = 0; tries < 6000 && !gone; ++tries) {
    gone = !Held(bench, "a");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(gone);
}

}  // namespace
}  // namespace rollgait::server
