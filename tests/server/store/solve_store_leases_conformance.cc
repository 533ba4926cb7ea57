// What agents ask of a store: claims, leases, events, ends, reclaim.
#include <set>
#include <thread>
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

TEST_P(SolveStoreConformance, ClaimTakesTheOldestOnce) {
  StoreBench bench(GetParam());
  bench.Add("a");
  bench.Add("b");
  const ClaimedSolve first = bench.store().ClaimNext("x", kLeaseDuration).value().value();
  EXPECT_EQ(first.record.id, "a");
  EXPECT_EQ(first.record.spec, "spec of a");
  EXPECT_EQ(first.record.attempts, 1);
  EXPECT_EQ(bench.Claim().solve_id, "b");
  EXPECT_FALSE(bench.CanClaim());
  const SolveRecord record = bench.Get("a");
  EXPECT_EQ(record.state, SolveState::kRunning);
  EXPECT_EQ(record.start_time_us, bench.clock().WallMicros());
  const v1::SolveEvent event = Parsed(bench.Events("a").back());
  EXPECT_EQ(event.state_change().state(), v1::SOLVE_STATE_RUNNING);
  EXPECT_EQ(event.state_change().attempt(), 1);
  const SolveCounts counts = bench.store().Counts().value();
  EXPECT_EQ(counts.queued, 0);
  EXPECT_EQ(counts.running, 2);
}

TEST_P(SolveStoreConformance, FinishWritesResultStateAndTerminalEventTogether) {
  StoreBench bench(GetParam());
  bench.Add("a");
  const Lease lease = bench.Claim();
  EXPECT_EQ(bench.store().AppendEvents(lease, {IterationEvent(0), IterationEvent(1)}).value().last_sequence, 4);
  ASSERT_TRUE(bench.store().Finish(lease, {IterationEvent(2)}, kAnswer).ok());
  bench.Restart();
  const SolveRecord record = bench.Get("a");
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.result, "the result");
  EXPECT_EQ(record.error, "");
  EXPECT_FALSE(record.from_cache);
  EXPECT_NE(record.end_time_us, 0);
  const std::vector<StoredEvent> events = bench.Events("a");
  ASSERT_EQ(events.size(), 6u);
  ExpectDense(events);
  EXPECT_EQ(Parsed(events[4]).iteration().index(), 2);
  EXPECT_EQ(events[5].kind, EventKind::kFinished);
  EXPECT_EQ(bench.store().List({10, "", std::nullopt}).value().records[0].result, "") << "lists carry no results";
  EXPECT_EQ(bench.store().Finish(lease, {}, kAnswer).error().code, ErrorCode::kLeaseLost);
}

TEST_P(SolveStoreConformance, ASolutionIsReplacedByTheNextAndByTheAnswer) {
  StoreBench bench(GetParam());
  for (const char* id : {"done", "cancelled", "back"}) bench.Add(id, std::string("key of ") + id);
  const Lease done = bench.Claim(), cancelled = bench.Claim(), back = bench.Claim();
  const auto keep = [&](const Lease& lease, const std::string& solution) {
    return bench.store().AppendAll({{lease, {}, solution}}).value()[0].ok();
  };
  const int64_t before = bench.Get("cancelled").last_sequence;
  for (const Lease& lease : {done, cancelled, back}) {
    ASSERT_TRUE(keep(lease, "first"));
    ASSERT_TRUE(keep(lease, "the second"));
    ASSERT_TRUE(keep(lease, "")) << "which leaves it";
    EXPECT_EQ(bench.Get(lease.solve_id).result, "the second");
  }
  EXPECT_EQ(bench.Get("cancelled").last_sequence, before) << "it is no event";
  EXPECT_TRUE(bench.store().Finish(done, {}, kAnswer).ok());
  EXPECT_EQ(bench.Get("done").result, kAnswer.result);
  EXPECT_TRUE(bench.store().Finish(cancelled, {}, {SolveState::kCancelled, "", "an error", false}).ok());
  EXPECT_EQ(bench.Get("cancelled").result, "the second");
  EXPECT_TRUE(bench.store().GiveBack(back, GiveBackReason::kStopping, "").ok());
  EXPECT_EQ(bench.Get("back").result, "the second");
  const Lease again = bench.Claim();
  EXPECT_EQ(again.solve_id, "back");
  EXPECT_FALSE(keep(back, "late"));
  EXPECT_TRUE(bench.store().Finish(again, {}, {SolveState::kCancelled, "the last", "an error", false}).ok());
  EXPECT_EQ(bench.Get("back").result, "the last");
  // None of them answers another solve with its solution.
  EXPECT_FALSE(bench.store().Create({"equal", "", "spec", "key of back"}).value().record.from_cache);
  for (const char* id : {"done", "cancelled", "back"}) EXPECT_TRUE(bench.store().Delete(id, {}).ok());
}

TEST_P(SolveStoreConformance, WritesUnderALostLeaseChangeNothing) {
  StoreBench bench(GetParam());
  bench.Add("a");
  const Lease old_lease = bench.Claim("old");
  bench.PassTime(kLeaseDuration + milliseconds(1));
  EXPECT_EQ(bench.store().ReclaimExpired().value(), std::vector<std::string>{"a"});
  const Lease new_lease = bench.Claim("old");  // the same owner: only the epoch tells them apart
  EXPECT_GT(new_lease.epoch, old_lease.epoch);
  const int64_t last = bench.Get("a").last_sequence;
  EXPECT_EQ(bench.store().AppendEvents(old_lease, {IterationEvent(0)}).error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(bench.store().RenewLease(old_lease, kLeaseDuration).error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(bench.store().Finish(old_lease, {}, kAnswer).error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(bench.store().GiveBack(old_lease, GiveBackReason::kCrashed, "").error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(bench.Get("a").last_sequence, last);
  EXPECT_EQ(bench.Get("a").crashes, 0);
  EXPECT_TRUE(bench.store().Finish(new_lease, {}, kAnswer).ok());
}

// An hour, and a minute's margin: no machine is so slow.
TEST_P(SolveStoreConformance, LeasesExpireByTheirOwnClockOnly) {
  constexpr std::chrono::minutes kLease(60), kNearly(59);
  StoreBench bench(GetParam());
  bench.Add("a");
  const Lease lease = bench.store().ClaimNext("agent", kLease).value().value().lease;
  bench.clock().JumpWall(std::chrono::hours(24 * 365));
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty());
  bench.PassTime(kNearly);
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty());
  ASSERT_TRUE(bench.store().RenewLease(lease, kLease).ok());
  bench.PassTime(kNearly);
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty()) << "the renewal counts from when it was made";
  bench.PassTime(kLease - kNearly + milliseconds(1));
  EXPECT_EQ(bench.store().ReclaimExpired().value().size(), 1u);
}

TEST_P(SolveStoreConformance, ReclaimedSolvesRunAgainAndNumbersGoOn) {
  StoreBench bench(GetParam());
  bench.Add("a");
  bench.Add("b");
  const Lease dead = bench.Claim("dead");
  const Lease alive = bench.Claim("alive");
  ASSERT_TRUE(bench.store().AppendEvents(dead, {IterationEvent(0)}).ok());
  std::set<std::string> owners;
  const std::vector<LeaseOwner> lease_owners = bench.store().LeaseOwners().value();
  for (const LeaseOwner& owner : lease_owners) {
    owners.insert(owner.owner);
    EXPECT_EQ(owner.running, 1);
  }
  EXPECT_EQ(owners, (std::set<std::string>{"dead", "alive"}));
  EXPECT_EQ(bench.store().ReclaimOwner("dead").value(), std::vector<std::string>{"a"});
  EXPECT_TRUE(bench.store().RenewLease(alive, kLeaseDuration).ok());
  const ClaimedSolve again = bench.store().ClaimNext("next", kLeaseDuration).value().value();
  EXPECT_EQ(again.record.id, "a");
  EXPECT_EQ(again.record.attempts, 2);
  EXPECT_EQ(again.record.crashes, 0);
  ASSERT_TRUE(bench.store().Finish(again.lease, {IterationEvent(0)}, kAnswer).ok());
  const std::vector<StoredEvent> events = bench.Events("a");
  ASSERT_EQ(events.size(), 7u);  // queued, running, iteration, queued, running, iteration, finished
  ExpectDense(events);
  EXPECT_EQ(Parsed(events[3]).state_change().state(), v1::SOLVE_STATE_QUEUED);
  EXPECT_NE(Parsed(events[3]).state_change().detail(), "");
  EXPECT_EQ(Parsed(events[4]).state_change().attempt(), 2);
}

TEST_P(SolveStoreConformance, TheThirdCrashIsTheLast) {
  StoreBench bench(GetParam());
  bench.Add("a");
  for (int crash = 1; crash < kMaxCrashes; ++crash) {
    const Lease lease = bench.Claim();
    EXPECT_EQ(bench.store().GiveBack(lease, GiveBackReason::kCrashed, "signal 11").value(), SolveState::kQueued);
  }
  for (const GiveBackReason reason : {GiveBackReason::kStopping, GiveBackReason::kNeverBegan}) {
    const Lease lease = bench.Claim();
    EXPECT_EQ(bench.store().GiveBack(lease, reason, "").value(), SolveState::kQueued);
  }
  const Lease last = bench.Claim();
  EXPECT_EQ(bench.store().GiveBack(last, GiveBackReason::kCrashed, "signal 11").value(), SolveState::kFailed);
  EXPECT_EQ(bench.ErrorOf("a").kind(), v1::SolveError::KIND_CRASH);
  EXPECT_NE(bench.ErrorOf("a").message().find("signal 11"), std::string::npos);
  EXPECT_EQ(bench.Get("a").attempts, kMaxCrashes + 2);
  EXPECT_EQ(bench.Events("a").back().kind, EventKind::kFinished);
  ExpectDense(bench.Events("a"));
  EXPECT_FALSE(bench.CanClaim());
}

TEST_P(SolveStoreConformance, CancellingARunningSolveSetsAFlagTheAgentSees) {
  StoreBench bench(GetParam());
  bench.Add("a");
  const Lease lease = bench.Claim("agent");
  EXPECT_TRUE(bench.store().CancelRequests("agent").value().empty());
  EXPECT_EQ(bench.store().RequestCancel("a").value().state, SolveState::kRunning);
  EXPECT_EQ(bench.store().CancelRequests("agent").value(), std::vector<std::string>{"a"});
  EXPECT_TRUE(bench.store().CancelRequests("other").value().empty());
  EXPECT_TRUE(bench.store().RenewLease(lease, kLeaseDuration).value().cancel_requested);
  EXPECT_TRUE(bench.store().AppendEvents(lease, {}).value().cancel_requested);
  ASSERT_TRUE(bench.store().Finish(lease, {}, {SolveState::kCancelled, "", "an error", false}).ok());
  EXPECT_EQ(bench.Get("a").state, SolveState::kCancelled);
  EXPECT_EQ(bench.Get("a").error, "an error");
  EXPECT_EQ(bench.store().RequestCancel("a").value().state, SolveState::kCancelled) << "no effect when finished";
}

TEST_P(SolveStoreConformance, ASolveToBeCancelledIsNotRunAgain) {
  StoreBench bench(GetParam());
  bench.Add("a");
  bench.Claim("dead");
  bench.store().RequestCancel("a").value();
  bench.store().ReclaimOwner("dead").value();
  EXPECT_EQ(bench.Get("a").state, SolveState::kCancelled);
  bench.Add("b");
  const Lease lease = bench.Claim();
  bench.store().RequestCancel("b").value();
  EXPECT_EQ(bench.store().GiveBack(lease, GiveBackReason::kCrashed, "killed").value(), SolveState::kCancelled);
}

TEST_P(SolveStoreConformance, ThreadsAndObjectsClaimEverySolveOnce) {
  StoreBench bench(GetParam());
  constexpr size_t kSolves = 40;
  for (size_t i = 0; i < kSolves; ++i) bench.Add(Numbered("s", i));
  const std::unique_ptr<SolveStore> second = bench.OpenAgain();
  std::vector<std::vector<std::string>> taken(4);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < taken.size(); ++t) {
    threads.emplace_back([&, t] {
      SolveStore& store = t % 2 == 0 ? bench.store() : *second;
      while (true) {
        const auto claimed = store.ClaimNext(Numbered("agent", t), kLeaseDuration);
        if (!claimed.ok() || !claimed.value().has_value()) return;
        const Lease& lease = claimed.value()->lease;
        if (!store.AppendEvents(lease, {IterationEvent(0)}).ok()) return;
        if (!store.Finish(lease, {}, kAnswer).ok()) return;
        taken[t].push_back(lease.solve_id);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::multiset<std::string> all;
  for (const auto& ids : taken) all.insert(ids.begin(), ids.end());
  EXPECT_EQ(all.size(), kSolves);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), kSolves);
  EXPECT_EQ(bench.Get("s7").last_sequence, 4);
}

}  // namespace
}  // namespace rollgait::server
