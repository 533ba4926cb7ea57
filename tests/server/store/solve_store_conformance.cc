#include "tests/server/store/solve_store_conformance.h"

#include <atomic>
#include <set>
#include <thread>
#include <vector>

#include "rollgait/v1/solve.pb.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

// A store of the kind under test and what the cases do again and again.
class Bench {
 public:
  explicit Bench(const StoreKind& kind) : kind_(kind), store_(kind.open(directory_.path(), clock_)) {}

  SolveStore& store() { return *store_; }
  FakeClock& clock() { return clock_; }
  std::unique_ptr<SolveStore> OpenAgain() { return kind_.open(directory_.path(), clock_); }
  void Restart() {
    store_.reset();
    store_ = OpenAgain();
  }

  SolveRecord Add(const std::string& id, const std::string& key = "") {
    return store_->Create({id, "", "spec of " + id, key}).value().record;
  }
  Lease Claim(const std::string& owner = "agent") {
    return store_->ClaimNext(owner, kLeaseDuration).value().value().lease;
  }
  bool CanClaim() { return store_->ClaimNext("prober", kLeaseDuration).value().has_value(); }
  SolveRecord Get(const std::string& id) { return store_->Get(id).value(); }
  std::vector<StoredEvent> Events(const std::string& id) { return store_->ReadEvents(id, 0, 1000).value().events; }
  v1::SolveError ErrorOf(const std::string& id) {
    v1::SolveError error;
    EXPECT_TRUE(error.ParseFromString(Get(id).error));
    return error;
  }

 private:
  TemporaryDirectory directory_;
  FakeClock clock_;
  const StoreKind& kind_;
  std::unique_ptr<SolveStore> store_;
};

std::string Numbered(const std::string& prefix, size_t number) { return prefix + std::to_string(number); }

StoredEvent IterationEvent(int index) {
  v1::SolveEvent event;
  event.mutable_iteration()->set_index(index);
  return {0, EventKind::kIteration, event.SerializeAsString()};
}

v1::SolveEvent Parsed(const StoredEvent& event) {
  v1::SolveEvent parsed;
  EXPECT_TRUE(parsed.ParseFromString(event.payload));
  return parsed;
}

void ExpectDense(const std::vector<StoredEvent>& events) {
  for (size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].sequence, static_cast<int64_t>(i) + 1);
}

const SolveEnd kAnswer{SolveState::kSucceeded, "the result", "", true};

TEST_P(SolveStoreConformance, CreatedSolveIsQueuedWithItsFirstEvent) {
  Bench bench(GetParam());
  const CreatedSolve created = bench.store().Create({"a", "", std::string("spec\0x", 6), "key"}).value();
  EXPECT_TRUE(created.created);
  const SolveRecord record = bench.Get("a");
  EXPECT_EQ(record.id, "a");
  EXPECT_EQ(record.spec, std::string("spec\0x", 6));
  EXPECT_EQ(record.solve_key, "key");
  EXPECT_EQ(record.state, SolveState::kQueued);
  EXPECT_EQ(record.create_time_us, bench.clock().WallMicros());
  EXPECT_EQ(record.attempts, 0);
  EXPECT_EQ(record.last_sequence, 1);
  const std::vector<StoredEvent> events = bench.Events("a");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::kStateChange);
  EXPECT_EQ(Parsed(events[0]).state_change().state(), v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(Parsed(events[0]).time().seconds(), bench.clock().WallMicros() / 1'000'000);
}

TEST_P(SolveStoreConformance, RequestIdMakesARetrySafe) {
  Bench bench(GetParam());
  ASSERT_TRUE(bench.store().Create({"a", "request", "spec", ""}).ok());
  const CreatedSolve again = bench.store().Create({"b", "request", "spec", ""}).value();
  EXPECT_FALSE(again.created);
  EXPECT_EQ(again.record.id, "a");
  EXPECT_EQ(bench.store().Get("b").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.store().Create({"c", "request", "another spec", ""}).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(bench.store().Counts().value().queued, 1);
}

TEST_P(SolveStoreConformance, FullQueueIsRefusedWithATimeToTryAgain) {
  Bench bench(GetParam());
  ASSERT_TRUE(bench.store().Create({"a", "", "s", "", 2}).ok());
  ASSERT_TRUE(bench.store().Create({"b", "r", "s", "", 2}).ok());
  const Outcome<CreatedSolve> third = bench.store().Create({"c", "", "s", "", 2});
  ASSERT_FALSE(third.ok());
  EXPECT_EQ(third.error().code, ErrorCode::kResourceExhausted);
  EXPECT_TRUE(third.error().retry_after.has_value());
  EXPECT_TRUE(bench.store().Create({"d", "r", "s", "", 2}).ok()) << "a retry of an accepted request is no new one";
  bench.Claim();
  EXPECT_TRUE(bench.store().Create({"c", "", "s", "", 2}).ok());
}

TEST_P(SolveStoreConformance, ListIsNewestFirstInPagesAndByState) {
  Bench bench(GetParam());
  for (size_t i = 0; i < 5; ++i) bench.Add(Numbered("s", i));
  bench.Claim();  // s0
  std::vector<std::string> ids;
  ListQuery query{2, "", std::nullopt};
  size_t pages = 0;
  do {
    const SolvePage page = bench.store().List(query).value();
    for (const SolveRecord& record : page.records) ids.push_back(record.id);
    query.page_token = page.next_page_token;
    bench.Add(Numbered("later", ++pages));  // what comes later does not shift the pages
  } while (!query.page_token.empty());
  EXPECT_EQ(ids, (std::vector<std::string>{"s4", "s3", "s2", "s1", "s0"}));
  EXPECT_EQ(pages, 3u);
  const SolvePage running = bench.store().List({10, "", SolveState::kRunning}).value();
  ASSERT_EQ(running.records.size(), 1u);
  EXPECT_EQ(running.records[0].id, "s0");
  EXPECT_EQ(running.next_page_token, "");
}

TEST_P(SolveStoreConformance, ForeignPageTokensAreRefused) {
  Bench bench(GetParam());
  for (size_t i = 0; i < 3; ++i) bench.Add(Numbered("s", i));
  const std::string token = bench.store().List({1, "", std::nullopt}).value().next_page_token;
  ASSERT_NE(token, "");
  EXPECT_TRUE(bench.store().List({1, token, std::nullopt}).ok());
  for (const std::string& bad : {token + "0", token.substr(1), std::string("x"), std::string(1000, 'a')}) {
    EXPECT_EQ(bench.store().List({1, bad, std::nullopt}).error().code, ErrorCode::kInvalidArgument) << bad;
  }
  EXPECT_EQ(bench.store().List({1, token, SolveState::kQueued}).error().code, ErrorCode::kInvalidArgument);
}

TEST_P(SolveStoreConformance, ClaimTakesTheOldestOnce) {
  Bench bench(GetParam());
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
  Bench bench(GetParam());
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

TEST_P(SolveStoreConformance, EventsAreReadAfterANumberInPages) {
  Bench bench(GetParam());
  bench.Add("a");
  const Lease lease = bench.Claim();
  ASSERT_TRUE(bench.store().AppendEvents(lease, {IterationEvent(0), IterationEvent(1), IterationEvent(2)}).ok());
  const EventPage page = bench.store().ReadEvents("a", 2, 2).value();
  ASSERT_EQ(page.events.size(), 2u);
  EXPECT_EQ(page.events[0].sequence, 3);
  EXPECT_EQ(page.last_sequence, 5);
  EXPECT_EQ(page.state, SolveState::kRunning);
  EXPECT_TRUE(bench.store().ReadEvents("a", 5, 10).value().events.empty());
  EXPECT_EQ(bench.store().ReadEvents("a", 6, 10).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(bench.store().ReadEvents("a", -1, 10).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(bench.store().ReadEvents("nobody", 0, 10).error().code, ErrorCode::kNotFound);
}

TEST_P(SolveStoreConformance, WritesUnderALostLeaseChangeNothing) {
  Bench bench(GetParam());
  bench.Add("a");
  const Lease old_lease = bench.Claim("old");
  bench.clock().Advance(kLeaseDuration + milliseconds(1));
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

TEST_P(SolveStoreConformance, LeasesExpireByTimeSinceBootOnly) {
  Bench bench(GetParam());
  bench.Add("a");
  const Lease lease = bench.Claim();
  bench.clock().JumpWall(std::chrono::hours(24 * 365));
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty());
  bench.clock().Advance(kLeaseDuration - milliseconds(1));
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty());
  ASSERT_TRUE(bench.store().RenewLease(lease, kLeaseDuration).ok());
  bench.clock().Advance(kLeaseDuration - milliseconds(1));
  EXPECT_TRUE(bench.store().ReclaimExpired().value().empty()) << "the renewal counts from when it was made";
  bench.clock().Advance(milliseconds(2));
  EXPECT_EQ(bench.store().ReclaimExpired().value().size(), 1u);
}

TEST_P(SolveStoreConformance, ARestartOfTheMachineEndsAllLeases) {
  Bench bench(GetParam());
  bench.Add("a");
  bench.Claim();
  bench.clock().Reboot("second-boot");  // its time since boot is smaller than the end of the lease
  bench.Restart();
  EXPECT_EQ(bench.store().ReclaimExpired().value(), std::vector<std::string>{"a"});
  EXPECT_EQ(bench.Get("a").state, SolveState::kQueued);
}

TEST_P(SolveStoreConformance, ReclaimedSolvesRunAgainAndNumbersGoOn) {
  Bench bench(GetParam());
  bench.Add("a");
  bench.Add("b");
  const Lease dead = bench.Claim("dead");
  const Lease alive = bench.Claim("alive");
  ASSERT_TRUE(bench.store().AppendEvents(dead, {IterationEvent(0)}).ok());
  const std::vector<std::string> owners = bench.store().LeaseOwners().value();
  EXPECT_EQ(std::set<std::string>(owners.begin(), owners.end()), (std::set<std::string>{"dead", "alive"}));
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
  Bench bench(GetParam());
  bench.Add("a");
  for (int crash = 1; crash < kMaxCrashes; ++crash) {
    const Lease lease = bench.Claim();
    EXPECT_EQ(bench.store().GiveBack(lease, GiveBackReason::kCrashed, "signal 11").value(), SolveState::kQueued);
  }
  const Lease stopped = bench.Claim();
  EXPECT_EQ(bench.store().GiveBack(stopped, GiveBackReason::kStopping, "").value(), SolveState::kQueued);
  const Lease last = bench.Claim();
  EXPECT_EQ(bench.store().GiveBack(last, GiveBackReason::kCrashed, "signal 11").value(), SolveState::kFailed);
  EXPECT_EQ(bench.ErrorOf("a").kind(), v1::SolveError::KIND_CRASH);
  EXPECT_NE(bench.ErrorOf("a").message().find("signal 11"), std::string::npos);
  EXPECT_EQ(bench.Get("a").attempts, kMaxCrashes + 1);
  EXPECT_EQ(bench.Events("a").back().kind, EventKind::kFinished);
  ExpectDense(bench.Events("a"));
  EXPECT_FALSE(bench.CanClaim());
}

TEST_P(SolveStoreConformance, CancellingAQueuedSolveEndsIt) {
  Bench bench(GetParam());
  bench.Add("a");
  EXPECT_EQ(bench.store().RequestCancel("a").value().state, SolveState::kCancelled);
  EXPECT_EQ(bench.ErrorOf("a").kind(), v1::SolveError::KIND_CANCELLED);
  EXPECT_EQ(bench.Events("a").back().kind, EventKind::kFinished);
  EXPECT_FALSE(bench.CanClaim());
  EXPECT_EQ(bench.store().RequestCancel("nobody").error().code, ErrorCode::kNotFound);
}

TEST_P(SolveStoreConformance, CancellingARunningSolveSetsAFlagTheAgentSees) {
  Bench bench(GetParam());
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
  Bench bench(GetParam());
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

TEST_P(SolveStoreConformance, OnlyFinishedSolvesAreDeleted) {
  Bench bench(GetParam());
  bench.Add("a");
  EXPECT_EQ(bench.store().Delete("a").error().code, ErrorCode::kFailedPrecondition);
  const Lease lease = bench.Claim();
  EXPECT_EQ(bench.store().Delete("a").error().code, ErrorCode::kFailedPrecondition);
  ASSERT_TRUE(bench.store().Finish(lease, {}, kAnswer).ok());
  EXPECT_TRUE(bench.store().Delete("a").ok());
  EXPECT_EQ(bench.store().Get("a").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.store().ReadEvents("a", 0, 1).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.store().Delete("a").error().code, ErrorCode::kNotFound);
}

TEST_P(SolveStoreConformance, AnEqualRequestIsAnsweredFromTheStore) {
  Bench bench(GetParam());
  bench.Add("a", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  // Even with a full queue: nothing is queued for it.
  const SolveRecord record = bench.store().Create({"b", "", "s", "key", 0}).value().record;
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_TRUE(record.from_cache);
  EXPECT_EQ(record.result, "the result");
  EXPECT_EQ(bench.Events("b").back().kind, EventKind::kFinished);
  ASSERT_TRUE(bench.store().Delete("a").ok());
  EXPECT_EQ(bench.Get("b").result, "the result") << "a shared result stays while a solve has it";
  ASSERT_TRUE(bench.store().Delete("b").ok());
  EXPECT_EQ(bench.Add("c", "key").state, SolveState::kQueued);
}

TEST_P(SolveStoreConformance, OnlyReusableResultsOfTheSameKeyAnswer) {
  Bench bench(GetParam());
  bench.Add("a", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, "infeasible", "", false}).ok());
  EXPECT_EQ(bench.Add("b", "key").state, SolveState::kQueued);
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  EXPECT_EQ(bench.Add("c", "another key").state, SolveState::kQueued);
  bench.Claim();
  bench.Add("d", "");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  EXPECT_EQ(bench.Add("e", "").state, SolveState::kQueued) << "an empty key equals nothing";
}

TEST_P(SolveStoreConformance, EqualRequestsRunOnce) {
  Bench bench(GetParam());
  bench.Add("a", "key");
  bench.Add("b", "key");
  bench.Add("c", "other");
  const Lease first = bench.Claim();
  EXPECT_EQ(bench.Claim().solve_id, "c") << "b waits for a";
  EXPECT_FALSE(bench.CanClaim());
  ASSERT_TRUE(bench.store().Finish(first, {}, kAnswer).ok());
  EXPECT_EQ(bench.Get("b").state, SolveState::kSucceeded);
  EXPECT_TRUE(bench.Get("b").from_cache);
  EXPECT_EQ(bench.Get("b").result, "the result");
  EXPECT_EQ(bench.Events("b").back().kind, EventKind::kFinished);
  ExpectDense(bench.Events("b"));
}

TEST_P(SolveStoreConformance, AnEqualRequestRunsWhenTheFirstGaveNoAnswer) {
  Bench bench(GetParam());
  bench.Add("a", "key");
  bench.Add("b", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kCancelled, "", "e", false}).ok());
  EXPECT_EQ(bench.Get("b").state, SolveState::kQueued);
  EXPECT_EQ(bench.Claim().solve_id, "b");
}

TEST_P(SolveStoreConformance, ThreadsAndObjectsClaimEverySolveOnce) {
  Bench bench(GetParam());
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
