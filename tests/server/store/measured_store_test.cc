#include "server/store/measured_store.h"

#include <gtest/gtest.h>

#include <memory>

#include "rollgait/v1/solve.pb.h"
#include "rollgait/v1/solve_spec.pb.h"
#include "server/store/open_store.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/scrape.h"

namespace rollgait::server {
namespace {

class MeasuredStoreTest : public testing::Test {
 protected:
  MeasuredStoreTest()
      : inner_(OpenStore({directory_.path() + "/rollgait.db"}, clock_).value()),
        store_(*inner_, metrics_),
        address_(metrics_.Listen("127.0.0.1:0").value()) {}

  double Sample(const std::string& name) {
    const auto samples = ParseExposition(Scrape(address_));
    return samples.contains(name) ? samples.at(name) : -1;
  }
  void Add(const std::string& id, const std::string& model) {
    v1::SolveSpec spec;
    spec.mutable_model()->set_name(model);
    NewSolve solve{id, "", spec.SerializeAsString(), "key of " + model};
    ASSERT_TRUE(store_.Create(solve).ok());
  }
  Lease Claim() { return store_.ClaimNext("agent", kLeaseDuration).value().value().lease; }
  static SolveEnd Optimal() {
    v1::SolveResult result;
    result.set_termination(v1::TERMINATION_OPTIMAL);
    return {SolveState::kSucceeded, result.SerializeAsString(), "", true};
  }

  TemporaryDirectory directory_;
  FakeClock clock_;
  std::unique_ptr<SqlStore> inner_;
  Metrics metrics_{"tester", "", ""};
  MeasuredStore store_;
  const std::string address_;
};

TEST_F(MeasuredStoreTest, FollowsASolveToItsEnd) {
  Add("a", "planar");
  EXPECT_EQ(Sample("rollgait_solves_created_total{source=\"queue\"}"), 1);
  const Lease lease = Claim();
  EXPECT_EQ(Sample("rollgait_leases"), 1);
  ASSERT_TRUE(store_.Finish(lease, {}, Optimal()).ok());
  EXPECT_EQ(Sample("rollgait_leases"), 0);
  EXPECT_EQ(Sample("rollgait_solves_total{model=\"planar\",state=\"succeeded\",termination=\"optimal\"}"), 1);
  EXPECT_EQ(Sample("rollgait_solve_seconds_count{model=\"planar\",termination=\"optimal\"}"), 1);
  EXPECT_EQ(Sample("rollgait_store_seconds_count{op=\"finish\"}"), 1);
  EXPECT_EQ(Sample("rollgait_cache_hits_total"), 0);
  Add("b", "planar");  // of the same key: answered from the store
  EXPECT_EQ(Sample("rollgait_cache_hits_total"), 1);
  EXPECT_EQ(Sample("rollgait_solves_created_total{source=\"cache\"}"), 1);
}

TEST_F(MeasuredStoreTest, TellsRetriesFromEnds) {
  Add("a", "human29");
  for (int crash = 1; crash <= kMaxCrashes; ++crash) {
    ASSERT_TRUE(store_.GiveBack(Claim(), GiveBackReason::kCrashed, "signal 11").ok());
  }
  EXPECT_EQ(Sample("rollgait_retries_total{reason=\"crash\"}"), kMaxCrashes - 1);
  EXPECT_EQ(Sample("rollgait_solves_total{model=\"human29\",state=\"failed\",termination=\"crash\"}"), 1);
  Add("b", "ball");
  ASSERT_TRUE(store_.GiveBack(Claim(), GiveBackReason::kNeverBegan, "signal 9").ok());
  EXPECT_EQ(Sample("rollgait_retries_total{reason=\"solver_gone\"}"), 1);
  ASSERT_TRUE(store_.GiveBack(Claim(), GiveBackReason::kStopping, "").ok());
  EXPECT_EQ(Sample("rollgait_retries_total{reason=\"agent_stopped\"}"), 1);
  Claim();
  ASSERT_TRUE(store_.ReclaimOwner("agent").ok());
  EXPECT_EQ(Sample("rollgait_retries_total{reason=\"agent_died\"}"), 1);
}

TEST_F(MeasuredStoreTest, CountsLostLeases) {
  Add("a", "planar");
  const Lease lease = Claim();
  ASSERT_TRUE(store_.ReclaimOwner("agent").ok());
  EXPECT_EQ(store_.RenewLease(lease, kLeaseDuration).error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(Sample("rollgait_lease_lost_total"), 1);
  EXPECT_EQ(Sample("rollgait_leases"), 0);
  EXPECT_EQ(Sample("rollgait_store_errors_total{op=\"renew_lease\"}"), 0);  // the store did its work
}

}  // namespace
}  // namespace rollgait::server
