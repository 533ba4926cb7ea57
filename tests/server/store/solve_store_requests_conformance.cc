// What clients ask of a store: create, read, list, cancel, delete, reuse of results.
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

TEST_P(SolveStoreConformance, CreatedSolveIsQueuedWithItsFirstEvent) {
  StoreBench bench(GetParam());
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
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.store().Create({"a", "request", "spec", ""}).ok());
  const CreatedSolve again = bench.store().Create({"b", "request", "spec", ""}).value();
  EXPECT_FALSE(again.created);
  EXPECT_EQ(again.record.id, "a");
  EXPECT_EQ(bench.store().Get("b").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.store().Create({"c", "request", "another spec", ""}).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(bench.store().Counts().value().queued, 1);
}

TEST_P(SolveStoreConformance, AWarmStartIsHandedToEveryAttemptUntilTheEnd) {
  StoreBench bench(GetParam());
  const std::string start("from\0there", 10);
  ASSERT_TRUE(bench.store().Create({"a", "", "s", "", 9, start}).ok());
  ASSERT_TRUE(bench.store().Create({"b", "", "s", ""}).ok());
  const ClaimedSolve first = bench.store().ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_EQ(first.warm_start, start);
  ASSERT_TRUE(bench.store().GiveBack(first.lease, GiveBackReason::kStopping, "").ok());
  bench.Restart();
  const ClaimedSolve second = bench.store().ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_EQ(second.lease.solve_id, "a");
  EXPECT_EQ(second.warm_start, start);
  EXPECT_EQ(bench.store().ClaimNext("agent", kLeaseDuration).value().value().warm_start, "");
  EXPECT_TRUE(bench.store().Finish(second.lease, {}, {SolveState::kSucceeded, "result", "", true}).ok());
  EXPECT_TRUE(bench.store().Delete("a").ok());
}

TEST_P(SolveStoreConformance, FullQueueIsRefusedWithATimeToTryAgain) {
  StoreBench bench(GetParam());
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
  StoreBench bench(GetParam());
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

// Lists tell termination and verdict without the result; a copy of an answer has those of the answer.
TEST_P(SolveStoreConformance, RecordsTellWhatTheResultSays) {
  StoreBench bench(GetParam());
  bench.Add("judged", "key");
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_OPTIMAL);
  result.mutable_accuracy()->set_verdict(v1::VERDICT_EXCEEDED);
  ASSERT_TRUE(
      bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
  const SolveRecord copy = bench.store().Create({"copy", "request", "spec of judged", "key"}).value().record;
  const SolveRecord again = bench.store().Create({"again", "request", "spec of judged", "key"}).value().record;
  EXPECT_EQ(again.id, "copy");
  bench.Add("unread");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, "\xff no result", "", true}).ok());
  bench.Add("waits");
  const std::vector<SolveRecord> listed = bench.store().List({10, "", std::nullopt}).value().records;
  ASSERT_EQ(listed.size(), 4u);
  EXPECT_EQ(listed[3].result, "");
  for (const SolveRecord& record : {listed[3], listed[2], bench.Get("judged"), bench.Get("copy"), copy, again}) {
    EXPECT_EQ(record.termination, v1::TERMINATION_OPTIMAL) << record.id;
    EXPECT_EQ(record.verdict, v1::VERDICT_EXCEEDED) << record.id;
  }
  for (const SolveRecord& record : {listed[1], listed[0]}) {
    EXPECT_EQ(record.termination, 0) << record.id;
    EXPECT_EQ(record.verdict, 0) << record.id;
  }
}

TEST_P(SolveStoreConformance, ForeignPageTokensAreRefused) {
  StoreBench bench(GetParam());
  for (size_t i = 0; i < 3; ++i) bench.Add(Numbered("s", i));
  const std::string token = bench.store().List({1, "", std::nullopt}).value().next_page_token;
  ASSERT_NE(token, "");
  EXPECT_TRUE(bench.store().List({1, token, std::nullopt}).ok());
  for (const std::string& bad : {token + "0", token.substr(1), std::string("x"), std::string(1000, 'a')}) {
    EXPECT_EQ(bench.store().List({1, bad, std::nullopt}).error().code, ErrorCode::kInvalidArgument) << bad;
  }
  EXPECT_EQ(bench.store().List({1, token, SolveState::kQueued}).error().code, ErrorCode::kInvalidArgument);
}

TEST_P(SolveStoreConformance, PageTokensDoNotTellHowManySolvesThereAre) {
  StoreBench bench(GetParam()), other(GetParam());
  for (size_t i = 0; i < 3; ++i) {
    bench.Add(Numbered("s", i));
    other.Add(Numbered("s", i));
  }
  const std::string token = bench.store().List({1, "", std::nullopt}).value().next_page_token;
  const std::string of_other = other.store().List({1, "", std::nullopt}).value().next_page_token;
  EXPECT_EQ(token.size(), of_other.size());
  EXPECT_NE(token, of_other) << "the same place of the same list";
  EXPECT_FALSE(bench.store().List({1, of_other, std::nullopt}).ok());
  bench.Restart();
  EXPECT_EQ(bench.store().List({1, token, std::nullopt}).value().records.front().id, "s1") << "it outlives a restart";
}

TEST_P(SolveStoreConformance, EventsAreReadAfterANumberInPages) {
  StoreBench bench(GetParam());
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

TEST_P(SolveStoreConformance, CancellingAQueuedSolveEndsIt) {
  StoreBench bench(GetParam());
  bench.Add("a");
  EXPECT_EQ(bench.store().RequestCancel("a").value().state, SolveState::kCancelled);
  EXPECT_EQ(bench.ErrorOf("a").kind(), v1::SolveError::KIND_CANCELLED);
  EXPECT_EQ(bench.Events("a").back().kind, EventKind::kFinished);
  EXPECT_FALSE(bench.CanClaim());
  EXPECT_EQ(bench.store().RequestCancel("nobody").error().code, ErrorCode::kNotFound);
}

TEST_P(SolveStoreConformance, OnlyFinishedSolvesAreDeleted) {
  StoreBench bench(GetParam());
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
  StoreBench bench(GetParam());
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

TEST_P(SolveStoreConformance, WhatIsAnsweredWithoutAPlaceNeedsNone) {
  StoreBench bench(GetParam());
  const auto needs_place = [&](const std::string& request_id, const std::string& key) {
    return bench.store().NeedsPlace({"new", request_id, "s", key}).value();
  };
  EXPECT_TRUE(needs_place("", ""));
  ASSERT_TRUE(bench.store().Create({"a", "mine", "s", "key"}).ok());
  EXPECT_FALSE(needs_place("mine", ""));
  EXPECT_TRUE(needs_place("another", ""));
  EXPECT_TRUE(needs_place("", "key")) << "its result is not here yet";
  NewSolve of_another_tenant{"new", "mine", "s", ""};
  of_another_tenant.actor.tenant = "rival";
  EXPECT_TRUE(bench.store().NeedsPlace(of_another_tenant).value());
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  EXPECT_FALSE(needs_place("", "key"));
  EXPECT_TRUE(needs_place("", "another key"));
  EXPECT_TRUE(needs_place("", "")) << "what has no key has no held result";
}

TEST_P(SolveStoreConformance, OnlyReusableResultsOfTheSameKeyAnswer) {
  StoreBench bench(GetParam());
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
  StoreBench bench(GetParam());
  bench.Add("a", "key");
  bench.Add("b", "key");
  bench.Add("c", "other");
  const Lease first = bench.Claim();
  EXPECT_EQ(bench.Claim().solve_id, "c") << "b waits for a";
  EXPECT_NE(Parsed(bench.Events("b")[0]).state_change().detail().find("solves/a"), std::string::npos);
  EXPECT_EQ(Parsed(bench.Events("a")[0]).state_change().detail(), "");
  EXPECT_FALSE(bench.CanClaim());
  ASSERT_TRUE(bench.store().Finish(first, {}, kAnswer).ok());
  EXPECT_EQ(bench.Get("b").state, SolveState::kSucceeded);
  EXPECT_TRUE(bench.Get("b").from_cache);
  EXPECT_EQ(bench.Get("b").result, "the result");
  EXPECT_EQ(bench.Events("b").back().kind, EventKind::kFinished);
  ExpectDense(bench.Events("b"));
}

TEST_P(SolveStoreConformance, AnEqualRequestRunsWhenTheFirstGaveNoAnswer) {
  StoreBench bench(GetParam());
  bench.Add("a", "key");
  bench.Add("b", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kCancelled, "", "e", false}).ok());
  EXPECT_EQ(bench.Get("b").state, SolveState::kQueued);
  EXPECT_EQ(bench.Claim().solve_id, "b");
}

}  // namespace
}  // namespace rollgait::server
