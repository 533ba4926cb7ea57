// The model knows whose turn it is.
#include "tests/schedules/history_bench.h"

namespace rollgait::server {
namespace {

using Kind = StoreCall::Kind;

// Solves of tenants that wait beside "a", which has the number 1 and no tenant.
class TurnModelTest : public HistoryBench {
 protected:
  void Wait(const std::string& id, const std::string& tenant, int priority = 0) {
    const auto number = static_cast<int64_t>(solves_.size()) + 1;
    solves_.push_back({.number = number, .id = id, .tag = id, .state = 1, .tenant = tenant, .priority = priority});
    Log(id, "queued");
    Commit({Kind::kCreate, {id}});
  }
  void ClaimOf(const std::string& id) {
    for (SeenSolve& solve : solves_) {
      if (solve.id != id) continue;
      solve.state = 2;
      solve.owner = "agent";
      solve.epoch += 1;
    }
    Log(id, "running");
    Commit({.kind = Kind::kClaim, .owner = "agent", .lease_us = 1000});
  }
};

TEST_F(TurnModelTest, TenantsTakeTurns) {
  model_.SetWeight("red", 2);
  for (const char* id : {"r1", "r2", "r3", "r4"}) Wait(id, "red");
  Wait("b1", "blue");
  Wait("b2", "blue");
  for (const char* id : {"r1", "b1", "a", "r2", "r3", "r4"}) ClaimOf(id);
  EXPECT_EQ(Violation(), "");
}

TEST_F(TurnModelTest, ATenantIsNotPassedOverMoreOftenThanItsShareSays) {
  for (const char* id : {"r1", "r2", "r3"}) Wait(id, "red");
  ClaimOf("r1");
  ClaimOf("r2");
  EXPECT_EQ(Violation(), "");
  ClaimOf("r3");
  Expect("of red is claimed while  waits, the last of more than 2 claims");
}

TEST_F(TurnModelTest, TheOldestOfOnePriorityIsFirst) {
  Wait("r1", "red");
  Wait("r2", "red");
  ClaimOf("r2");
  Expect("r1: has the turn of its tenant, and r2 is claimed");
}

TEST_F(TurnModelTest, TheHighestPriorityIsFirst) {
  Wait("r1", "red");
  Wait("r2", "red", 1);
  ClaimOf("r1");
  Expect("r2: has the turn of its tenant, and r1 is claimed");
}

TEST_F(TurnModelTest, APriorityChangesOnRequestOnly) {
  a().priority = 1;
  Commit({.kind = Kind::kSetPriority, .id = "a"});
  EXPECT_EQ(Violation(), "");
  a().priority = 2;
  Commit({.kind = Kind::kCancel, .id = "a"});
  Expect("has another priority");
}

}  // namespace
}  // namespace rollgait::server
