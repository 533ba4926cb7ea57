#include "server/service/watch_hub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "tests/server/service/service_fixture.h"
#include "tests/server/service/wake_bell.h"

namespace rollgait::server {
namespace {

// Reads one watch as a stream would: sleeps until woken, then takes.
class Reader {
 public:
  Reader(ServiceBench& bench, const std::string& id, int64_t after, int iterates_per_second = 0)
      : watch_(bench.hub().Open({id, after, iterates_per_second}, [bell = bell_] { bell->Ring(); }).value()) {}

  // Adds what comes until `done(events)`; false if the watch ended or failed before.
  template <typename Condition>
  bool Until(Condition done) {
    while (!done(events)) {
      Outcome<WatchBatch> batch = watch_->Take();
      if (!batch.ok()) {
        failure = batch.error();
        return false;
      }
      events.insert(events.end(), batch.value().events.begin(), batch.value().events.end());
      ended = batch.value().ended;
      if (ended) return done(events);
      if (!batch.value().events.empty()) continue;
      bell_->Wait();
    }
    return true;
  }
  bool UntilCount(size_t count) {
    return Until([count](const std::vector<EventPtr>& all) { return all.size() >= count; });
  }
  bool UntilEnd() {
    Until([](const std::vector<EventPtr>&) { return false; });
    return ended;
  }

  std::vector<EventPtr> events;
  bool ended = false;
  std::optional<Error> failure;

 private:
  const std::shared_ptr<WakeBell> bell_ = std::make_shared<WakeBell>();  // rings after the reader's end, too
  std::unique_ptr<Watch> watch_;
};

void ExpectDenseAfter(const std::vector<EventPtr>& events, int64_t after) {
  for (const EventPtr& event : events) EXPECT_EQ(event->sequence(), ++after);
}

TEST(WatchHubTest, EventsArriveAsTheyAreWrittenAndTheLastIsTheFinishedSolve) {
  ServiceBench bench;
  const std::string id = bench.Create();
  Reader reader(bench, id, 0);
  ASSERT_TRUE(reader.UntilCount(1));
  EXPECT_EQ(reader.events[0]->state_change().state(), v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(reader.events[0]->name(), "solves/" + id);
  const Lease lease = bench.Claim();
  bench.Hint(id);
  ASSERT_TRUE(reader.UntilCount(2));
  bench.AppendIterations(lease, 0, 3);
  ASSERT_TRUE(reader.UntilCount(5));
  EXPECT_EQ(reader.events[4]->iteration().index(), 2);
  bench.Finish(lease);
  ASSERT_TRUE(reader.UntilEnd());
  ExpectDenseAfter(reader.events, 0);
  const v1::Solve& solve = reader.events.back()->finished();
  EXPECT_EQ(solve.name(), "solves/" + id);
  EXPECT_EQ(solve.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(solve.result().message(), "found");
  EXPECT_EQ(solve.last_sequence(), reader.events.back()->sequence());
}

TEST(WatchHubTest, LostHintsDoNotMatter) {
  ServiceBench bench;
  const std::string id = bench.Create();
  Reader reader(bench, id, 0);
  ASSERT_TRUE(reader.UntilCount(1));
  const Lease lease = bench.Claim();  // nobody says so
  ASSERT_TRUE(bench.store().Finish(lease, {}, {SolveState::kSucceeded, "", "", false}).ok());
  EXPECT_TRUE(reader.UntilEnd());
  EXPECT_EQ(reader.events.size(), 3u);
}

TEST(WatchHubTest, ReadersJoinAtAnyNumberAndMissNothing) {
  ServiceBench bench;
  const std::string id = bench.Create();
  const Lease lease = bench.Claim();
  bench.AppendIterations(lease, 0, 3000);  // more than a feed holds in memory
  Reader first(bench, id, 0);
  ASSERT_TRUE(first.UntilCount(3002));
  bench.AppendIterations(lease, 3000, 1500);
  ASSERT_TRUE(first.UntilCount(4502));
  Reader from_memory(bench, id, 4400), from_store(bench, id, 17), from_end(bench, id, 4502);
  bench.Finish(lease);
  for (Reader* reader : {&first, &from_memory, &from_store, &from_end}) EXPECT_TRUE(reader->UntilEnd());
  ExpectDenseAfter(first.events, 0);
  ExpectDenseAfter(from_memory.events, 4400);
  ExpectDenseAfter(from_store.events, 17);
  ExpectDenseAfter(from_end.events, 4502);
  EXPECT_EQ(first.events.size(), 4503u);
  EXPECT_EQ(from_memory.events.size(), 103u);
  EXPECT_EQ(from_store.events.size(), 4486u);
  EXPECT_EQ(from_end.events.size(), 1u);
}

TEST(WatchHubTest, AFinishedSolveEndsAtOnce) {
  ServiceBench bench;
  const std::string id = bench.Create();
  bench.Finish(bench.Claim());
  Reader all(bench, id, 0), nothing(bench, id, 3);
  EXPECT_TRUE(all.UntilEnd());
  EXPECT_EQ(all.events.size(), 3u);
  EXPECT_TRUE(nothing.UntilEnd());
  EXPECT_TRUE(nothing.events.empty());
}

// True once the hub has read what is new: some reader is behind.
bool HubHasNews(ServiceBench& bench) {
  for (int i = 0; i < 1000 && bench.hub().GetStats().max_lag == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return bench.hub().GetStats().max_lag > 0;
}

TEST(WatchHubTest, AShortResultIsHeldAndALongOneIsReadFromTheStoreByEachReader) {
  for (const size_t length : {size_t{1} << 10, size_t{1} << 17}) {
    ServiceBench bench;
    const std::string id = bench.Create();
    const Lease lease = bench.Claim();
    Reader kept(bench, id, 2);
    bench.Finish(lease, std::string(length, 'm'));
    ASSERT_TRUE(HubHasNews(bench));
    ASSERT_TRUE(kept.UntilEnd()) << length;
    ASSERT_EQ(kept.events.size(), 1u);
    EXPECT_EQ(kept.events[0]->sequence(), 3);
    EXPECT_EQ(kept.events[0]->finished().result().message().size(), length);
    Reader late(bench, id, 2);
    ASSERT_TRUE(late.UntilEnd()) << length;
    EXPECT_EQ(late.events[0]->finished().result().message().size(), length);
  }
  for (const size_t length : {size_t{1} << 10, size_t{1} << 17}) {
    ServiceBench bench;
    const std::string id = bench.Create();
    const Lease lease = bench.Claim();
    Reader reader(bench, id, 2);
    bench.Finish(lease, std::string(length, 'm'));
    ASSERT_TRUE(HubHasNews(bench));
    ASSERT_TRUE(bench.store().Delete(id).ok());
    if (length < (64 << 10)) {
      EXPECT_TRUE(reader.UntilEnd()) << "from memory";
    } else {
      EXPECT_FALSE(reader.UntilEnd()) << "nowhere";
      ASSERT_TRUE(reader.failure.has_value());
      EXPECT_EQ(reader.failure->code, ErrorCode::kNotFound);
    }
  }
}

TEST(WatchHubTest, ASolveThatWasDeletedUnseenIsNotFound) {
  ServiceBench bench;
  bool unseen = false;
  for (int attempt = 0; attempt < 20 && !unseen; ++attempt) {  // the hub may look between the two calls
    const std::string id = bench.Create();
    Reader reader(bench, id, 0);
    ASSERT_TRUE(reader.UntilCount(1));
    ASSERT_TRUE(bench.store().RequestCancel(id).ok());
    ASSERT_TRUE(bench.store().Delete(id).ok());  // nobody says so
    if (reader.UntilEnd()) continue;
    unseen = true;
    ASSERT_TRUE(reader.failure.has_value());
    EXPECT_EQ(reader.failure->code, ErrorCode::kNotFound);
    EXPECT_NE(reader.failure->message.find(id), std::string::npos) << reader.failure->message;
  }
  EXPECT_TRUE(unseen);
}

TEST(WatchHubTest, BadPlacesAreRefused) {
  ServiceBench bench;
  const std::string id = bench.Create();
  EXPECT_EQ(bench.hub().Open({id, 2}, [] {}).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(bench.hub().Open({id, -1}, [] {}).error().code, ErrorCode::kOutOfRange);
  EXPECT_EQ(bench.hub().Open({"none", 0}, [] {}).error().code, ErrorCode::kNotFound);
}

TEST(WatchHubTest, HeartbeatsRepeatTheLastNumber) {
  ServiceBench bench(std::chrono::milliseconds(10));
  Reader reader(bench, bench.Create(), 0);
  ASSERT_TRUE(reader.UntilCount(3));
  EXPECT_TRUE(reader.events[0]->has_state_change());
  EXPECT_TRUE(reader.events[1]->has_heartbeat());
  EXPECT_TRUE(reader.events[2]->has_heartbeat());
  EXPECT_EQ(reader.events[1]->sequence(), 1);
  EXPECT_EQ(reader.events[2]->sequence(), 1);
}

void PutIterate(ServiceBench& bench, const std::string& id, int index) {
  v1::Iterate iterate;
  iterate.set_index(index);
  ASSERT_TRUE(bench.iterates().Put(id, iterate.SerializeAsString()).ok());
}

TEST(WatchHubTest, TheNewestIterateComesToThoseWhoAskAndToNobodyElse) {
  ServiceBench bench;
  ASSERT_TRUE(bench.iterates().MakeDirectory().ok());
  const std::string id = bench.Create();
  const Lease lease = bench.Claim();
  PutIterate(bench, id, 7);
  PutIterate(bench, id, 8);
  Reader asks(bench, id, 0, 4), asks_not(bench, id, 0);
  ASSERT_TRUE(asks.Until([](const std::vector<EventPtr>& all) { return !all.empty() && all.back()->has_iterate(); }));
  EXPECT_EQ(asks.events.back()->iterate().index(), 8);
  EXPECT_EQ(asks.events.back()->name(), "solves/" + id);
  EXPECT_GT(asks.events.back()->time().seconds(), 0);
  PutIterate(bench, id, 9);
  ASSERT_TRUE(asks.Until([](const std::vector<EventPtr>& all) { return all.back()->iterate().index() == 9; }));
  bench.AppendIterations(lease, 0, 3);
  bench.Finish(lease);
  for (Reader* reader : {&asks, &asks_not}) {
    EXPECT_TRUE(reader->UntilEnd());
    std::vector<EventPtr> stored = reader->events;
    std::erase_if(stored, [](const EventPtr& event) { return event->has_iterate(); });
    EXPECT_EQ(reader->events.size() - stored.size(), reader == &asks ? 2u : 0u);
    ExpectDenseAfter(stored, 0);
    EXPECT_TRUE(reader->events.back()->has_finished());
    for (size_t i = 1; i < reader->events.size(); ++i) {
      if (reader->events[i]->has_iterate()) {
        EXPECT_EQ(reader->events[i]->sequence(), reader->events[i - 1]->sequence()) << "repeats the last number";
      }
    }
  }
}

TEST(WatchHubTest, IteratesComeNoFasterThanTheyAreAskedFor) {
  ServiceBench bench;
  ASSERT_TRUE(bench.iterates().MakeDirectory().ok());
  const std::string id = bench.Create();
  const Lease lease = bench.Claim();
  const auto start = std::chrono::steady_clock::now();
  Reader once(bench, id, 0, 1), often(bench, id, 0, 4);
  std::vector<std::thread> readers;
  for (Reader* reader : {&once, &often}) readers.emplace_back([reader] { reader->UntilEnd(); });
  int index = 0;
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1500)) {
    PutIterate(bench, id, ++index);
    bench.Hint(id);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  bench.Finish(lease);
  for (std::thread& reader : readers) reader.join();
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto shown = [](const Reader& reader) {
    EXPECT_TRUE(reader.ended);
    return static_cast<double>(std::count_if(reader.events.begin(), reader.events.end(),
                                             [](const EventPtr& event) { return event->has_iterate(); }));
  };
  EXPECT_GE(shown(once), 1);
  EXPECT_LE(shown(once), 1 + elapsed_s);
  EXPECT_GT(shown(often), shown(once));
  EXPECT_LE(shown(often), 1 + 4 * elapsed_s);
  EXPECT_GT(index, 10) << "more than were shown";
}

TEST(WatchHubTest, StopWakesReadersAndRefusesNewOnes) {
  ServiceBench bench;
  const std::string id = bench.Create();
  Reader reader(bench, id, 0);
  ASSERT_TRUE(reader.UntilCount(1));
  bench.hub().Stop();
  EXPECT_FALSE(reader.UntilCount(2));
  ASSERT_TRUE(reader.failure.has_value());
  EXPECT_EQ(reader.failure->code, ErrorCode::kUnavailable);
  EXPECT_EQ(bench.hub().Open({id, 0}, [] {}).error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace rollgait::server
