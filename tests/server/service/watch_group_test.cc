#include "server/service/watch_group.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>

#include "tests/server/service/service_fixture.h"
#include "tests/server/service/wake_bell.h"

namespace rollgait::server {
namespace {

// Reads a group as a stream would: sleeps until woken, then takes.
class GroupReader {
 public:
  GroupReader(ServiceBench& bench, const std::vector<WatchPosition>& positions)
      : group_(WatchGroup::Open(bench.hub(), positions, [bell = bell_] { bell->Ring(); }).value()) {}

  // The next batch with something in it, or the last one.
  Outcome<WatchBatch> Next() {
    while (true) {
      Outcome<WatchBatch> batch = group_->Take();
      if (!batch.ok() || batch.value().ended || !batch.value().events.empty()) return batch;
      bell_->Wait();
    }
  }
  // All that comes until the end, by name; every batch is of one solve and no longer than a Watch's.
  std::map<std::string, std::vector<EventPtr>> ReadAll() {
    std::map<std::string, std::vector<EventPtr>> events;
    for (bool ended = false; !ended;) {
      const Outcome<WatchBatch> batch = Next();
      if (!batch.ok()) {
        ADD_FAILURE() << batch.error().message;
        break;
      }
      ended = batch.value().ended;
      EXPECT_LE(batch.value().events.size(), static_cast<size_t>(Watch::kMaxBatch));
      std::set<std::string> names;
      for (const EventPtr& event : batch.value().events) {
        names.insert(event->name());
        events[event->name()].push_back(event);
      }
      EXPECT_LE(names.size(), 1u);
    }
    return events;
  }

 private:
  const std::shared_ptr<WakeBell> bell_ = std::make_shared<WakeBell>();  // rings after the reader's end, too
  std::unique_ptr<EventSource> group_;
};

std::vector<WatchPosition> CreateThree(ServiceBench& bench) {
  std::vector<WatchPosition> positions;
  for (const double slope : {0.1, 0.2, 0.3}) positions.push_back({bench.Create(PlanarSpec(slope)), 0});
  return positions;
}

TEST(WatchGroupTest, EverySolvesEventsComeInTheirOrderToTheLastEnd) {
  ServiceBench bench;
  const std::vector<WatchPosition> positions = CreateThree(bench);
  GroupReader reader(bench, positions);
  for (int i = 0; i < 3; ++i) {
    const Lease lease = bench.Claim();
    bench.AppendIterations(lease, 0, 100 * (i + 1));
    bench.Finish(lease);
  }
  const auto events = reader.ReadAll();
  ASSERT_EQ(events.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const std::vector<EventPtr>& own = events.at(SolveName(positions[i].id));
    ASSERT_EQ(own.size(), 100 * (i + 1) + 3);  // queued, running, iterations, finished
    for (size_t k = 0; k < own.size(); ++k) EXPECT_EQ(own[k]->sequence(), static_cast<int64_t>(k) + 1);
    EXPECT_TRUE(own.back()->has_finished());
  }
}

TEST(WatchGroupTest, EachGoesOnAfterItsOwnNumber) {
  ServiceBench bench;
  std::vector<WatchPosition> positions = CreateThree(bench);
  for (int i = 0; i < 3; ++i) {
    const Lease lease = bench.Claim();
    bench.AppendIterations(lease, 0, 5);
    bench.Finish(lease);
  }
  positions[0].after_sequence = 8;  // all of it
  positions[1].after_sequence = 6;
  const auto events = GroupReader(bench, positions).ReadAll();
  EXPECT_EQ(events.count(SolveName(positions[0].id)), 0u);
  EXPECT_EQ(events.at(SolveName(positions[1].id)).size(), 2u);
  EXPECT_EQ(events.at(SolveName(positions[2].id)).size(), 8u);
}

TEST(WatchGroupTest, ThoseThatHaveEndedAreLetGo) {
  ServiceBench bench;
  const std::vector<WatchPosition> positions = CreateThree(bench);
  GroupReader reader(bench, positions);
  EXPECT_EQ(bench.hub().GetStats().readers, 3);
  bench.Finish(bench.Claim());
  for (bool finished = false; !finished;) {
    const Outcome<WatchBatch> batch = reader.Next();
    ASSERT_TRUE(batch.ok());
    EXPECT_FALSE(batch.value().ended);
    for (const EventPtr& event : batch.value().events) finished = finished || event->has_finished();
  }
  EXPECT_EQ(bench.hub().GetStats().readers, 2);
}

TEST(WatchGroupTest, HeartbeatsAreThoseOfOneStream) {
  constexpr std::chrono::milliseconds kInterval{300};
  ServiceBench bench(kInterval);
  GroupReader reader(bench, CreateThree(bench));
  for (int i = 0; i < 3; ++i) ASSERT_FALSE(reader.Next().value().events.front()->has_heartbeat());
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) {
    const Outcome<WatchBatch> batch = reader.Next();
    ASSERT_TRUE(batch.ok());
    ASSERT_TRUE(batch.value().events.front()->has_heartbeat());
  }
  // Three solves that each had their own would give three at once.
  EXPECT_GE(std::chrono::steady_clock::now() - start, 2 * kInterval);
}

TEST(WatchGroupTest, TheFirstThatIsNotThereIsTheAnswer) {
  ServiceBench bench;
  std::vector<WatchPosition> positions = CreateThree(bench);
  positions[1].after_sequence = 9;
  EXPECT_EQ(WatchGroup::Open(bench.hub(), positions, [] {}).error().code, ErrorCode::kOutOfRange);
  positions[1] = {"none", 0};
  EXPECT_EQ(WatchGroup::Open(bench.hub(), positions, [] {}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.hub().GetStats().readers, 0);
}

TEST(WatchGroupTest, AStopEndsIt) {
  ServiceBench bench;
  GroupReader reader(bench, CreateThree(bench));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(reader.Next().ok());
  bench.hub().Stop();
  EXPECT_EQ(reader.Next().error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace rollgait::server
