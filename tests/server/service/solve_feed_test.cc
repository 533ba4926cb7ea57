#include "server/service/solve_feed.h"

#include <gtest/gtest.h>

#include "rollgait/v1/solve.pb.h"
#include "server/store/open_store.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using std::chrono::hours;

// A store with the solve "a", which waits.
class SolveFeedTest : public ::testing::Test {
 protected:
  SolveFeedTest() : store_(OpenStore({directory_.path() + "/rollgait.db"}, clock_).value()) {
    EXPECT_TRUE(store_->Create({"a", "", "", ""}).ok());
  }
  // Number of the newest event.
  int64_t Last() { return store_->LastSequences({"a"}).value().at("a"); }
  SolveFeed Feed() { return {*store_, iterates_, "a", Last(), IsTerminal(store_->Get("a").value().state)}; }
  // The solve runs and ends, and retention leaves the terminal event alone.
  void EndAndTrim() {
    const Lease lease = store_->ClaimNext("agent", kLeaseDuration).value().value().lease;
    EXPECT_TRUE(store_->Finish(lease, {}, {SolveState::kCancelled, "", "", false}).ok());
    clock_.Advance(hours(2));
    RetentionLimits limits;
    limits.events = hours(1);
    EXPECT_EQ(store_->Retain(limits).value().event_logs, 1);
  }

  TemporaryDirectory directory_;
  FakeClock clock_;
  std::unique_ptr<SqlStore> store_;
  IterateFiles iterates_{directory_.path()};
};

// Found by schedule 216811 of SQLite: while the database was away the solve ended and lost its events, and its readers
// then waited for ever.
TEST_F(SolveFeedTest, WhatRetentionHasRemovedIsSkipped) {
  SolveFeed feed = Feed();
  EndAndTrim();
  EXPECT_TRUE(feed.Refresh().value()) << "readers are to look";
  EXPECT_EQ(feed.last_sequence(), Last());
  EXPECT_EQ(feed.After(1, 10).error().code, ErrorCode::kOutOfRange) << "events 2 and later are gone";
  const std::vector<EventPtr> held = feed.After(Last() - 1, 10).value();
  ASSERT_EQ(held.size(), 1u);
  EXPECT_TRUE(held[0]->has_finished());
  EXPECT_TRUE(feed.EndedBy(Last()));
  EXPECT_FALSE(feed.EndedBy(1));
  EXPECT_FALSE(feed.Refresh().value());
}

TEST_F(SolveFeedTest, ASolveThatIsDeletedAfterItsEventsIsTold) {
  SolveFeed feed = Feed();
  EndAndTrim();
  ASSERT_TRUE(store_->Delete("a").ok());
  EXPECT_TRUE(feed.Refresh().value());
  EXPECT_EQ(feed.After(1, 10).error().code, ErrorCode::kNotFound);
}

// As after a restore of an older store.
TEST_F(SolveFeedTest, AStoreThatKnowsLessIsTold) {
  SolveFeed feed(*store_, iterates_, "a", Last() + 5, false);
  EXPECT_TRUE(feed.Refresh().value());
  EXPECT_EQ(feed.After(Last() + 5, 10).error().code, ErrorCode::kOutOfRange);
}

}  // namespace
}  // namespace rollgait::server
