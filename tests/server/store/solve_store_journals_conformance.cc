// What an attempt keeps in the store for the next one.
#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

TEST_P(SolveStoreConformance, AJournalIsReplacedByTheNextAndOutlivesTheLease) {
  StoreBench bench(GetParam());
  bench.Add("a");
  EXPECT_FALSE(bench.store().ReadJournal("a").value());
  const Lease first = bench.Claim();
  ASSERT_TRUE(bench.store().PutJournal(first, "so far").ok());
  const std::string bytes = std::string("no\0text\xff", 9) + std::string(3 << 20, 'x');
  ASSERT_TRUE(bench.store().PutJournal(first, bytes).ok());
  bench.Restart();
  ASSERT_TRUE(bench.store().GiveBack(first, GiveBackReason::kStopping, "").ok());
  const StoredJournal kept = bench.store().ReadJournal("a").value().value();
  EXPECT_EQ(kept.epoch, first.epoch);
  EXPECT_EQ(kept.content, bytes);
  const Lease second = bench.Claim();
  ASSERT_TRUE(bench.store().PutJournal(second, "further").ok());
  EXPECT_EQ(bench.store().ReadJournal("a").value()->epoch, second.epoch);
  EXPECT_EQ(bench.store().ReadJournal("a").value()->content, "further");
}

TEST_P(SolveStoreConformance, AnAttemptWhoseLeaseIsLostKeepsNoJournal) {
  StoreBench bench(GetParam());
  bench.Add("a");
  const Lease old_lease = bench.Claim();
  bench.PassTime(kLeaseDuration + milliseconds(1));
  ASSERT_EQ(bench.store().ReclaimExpired().value().size(), 1u);
  EXPECT_EQ(bench.store().PutJournal(old_lease, "late").error().code, ErrorCode::kLeaseLost);
  EXPECT_FALSE(bench.store().ReadJournal("a").value()) << "of a queued solve";
  const Lease new_lease = bench.Claim();
  ASSERT_TRUE(bench.store().PutJournal(new_lease, "new").ok());
  EXPECT_EQ(bench.store().PutJournal(old_lease, "late").error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(bench.store().ReadJournal("a").value()->content, "new");
}

// However it ends, and whoever ends it.
TEST_P(SolveStoreConformance, JournalsGoWithTheEndOfTheirSolve) {
  StoreBench bench(GetParam());
  for (const char* id : {"finished", "crashed", "cancelled", "kept"}) bench.Add(id);
  const Lease finished = bench.Claim(), crashed = bench.Claim(), cancelled = bench.Claim(), goes_on = bench.Claim();
  for (const Lease& lease : {finished, crashed, cancelled, goes_on}) {
    ASSERT_TRUE(bench.store().PutJournal(lease, "of " + lease.solve_id).ok());
  }
  ASSERT_TRUE(bench.store().Finish(finished, {}, kAnswer).ok());
  Lease lease = crashed;
  for (int crash = 1; crash < kMaxCrashes; ++crash) {
    ASSERT_EQ(bench.store().GiveBack(lease, GiveBackReason::kCrashed, "").value(), SolveState::kQueued);
    EXPECT_TRUE(bench.store().ReadJournal("crashed").value());
    lease = bench.Claim();
  }
  ASSERT_EQ(bench.store().GiveBack(lease, GiveBackReason::kCrashed, "").value(), SolveState::kFailed);
  ASSERT_TRUE(bench.store().GiveBack(cancelled, GiveBackReason::kStopping, "").ok());
  ASSERT_TRUE(bench.store().RequestCancel("cancelled").ok());
  for (const char* id : {"finished", "crashed", "cancelled"}) EXPECT_FALSE(bench.store().ReadJournal(id).value()) << id;
  EXPECT_EQ(bench.store().ReadJournal("kept").value()->content, "of kept");
  EXPECT_FALSE(bench.store().ReadJournal("nobody").value());
}

}  // namespace
}  // namespace rollgait::server
