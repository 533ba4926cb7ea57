#ifndef ROLLGAIT_TESTS_SERVER_STORE_STORE_BENCH_H_
#define ROLLGAIT_TESTS_SERVER_STORE_STORE_BENCH_H_

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"
#include "tests/server/store/solve_store_conformance.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {

// A store of the kind under test and what the cases do again and again.
class StoreBench {
 public:
  explicit StoreBench(const StoreKind& kind) : kind_(kind), store_(kind.open(directory_.path(), clock_)) {}

  SolveStore& store() { return *store_; }
  ModelStore& models() { return *store_; }
  FakeClock& clock() { return clock_; }
  // For leases; by more than a test takes, on engines whose clock cannot be stopped.
  void PassTime(std::chrono::milliseconds time) { kind_.pass_time(directory_.path(), clock_, time); }
  std::unique_ptr<SqlStore> OpenAgain() { return kind_.open(directory_.path(), clock_); }
  // Nobody of this process has the store open; before fork.
  void Close() { store_.reset(); }
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
  std::unique_ptr<SqlStore> store_;
};

inline std::string Numbered(const std::string& prefix, size_t number) { return prefix + std::to_string(number); }

inline StoredEvent IterationEvent(int index) {
  v1::SolveEvent event;
  event.mutable_iteration()->set_index(index);
  return {0, EventKind::kIteration, event.SerializeAsString()};
}

inline v1::SolveEvent Parsed(const StoredEvent& event) {
  v1::SolveEvent parsed;
  EXPECT_TRUE(parsed.ParseFromString(event.payload));
  return parsed;
}

inline void ExpectDense(const std::vector<StoredEvent>& events) {
  for (size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].sequence, static_cast<int64_t>(i) + 1);
}

// A solve of planar with an answer, one of human29 without, one that carries its model, and one whose spec says
// nothing; more of the first than a migration reads at once.
inline void FillForFilters(SolveStore& store) {
  v1::SolveSpec planar, human, own;
  planar.mutable_model()->set_name("planar");
  human.mutable_model()->set_name("human29");
  own.mutable_model()->mutable_own();
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_ACCEPTABLE);
  result.mutable_accuracy()->set_verdict(v1::VERDICT_WITHIN);
  const std::string answer = result.SerializeAsString();
  for (size_t i = 0; i < 101; ++i) {
    ASSERT_TRUE(store.Create({Numbered("planar", i), "", planar.SerializeAsString(), ""}).ok());
  }
  const ClaimedSolve claimed = store.ClaimNext("agent", kLeaseDuration).value().value();
  ASSERT_TRUE(store.Finish(claimed.lease, {}, {SolveState::kSucceeded, answer, "", true}).ok());
  ASSERT_TRUE(store.Create({"human", "", human.SerializeAsString(), ""}).ok());
  ASSERT_TRUE(store.Create({"own", "", own.SerializeAsString(), ""}).ok());
  ASSERT_TRUE(store.Create({"unread", "", "\xff", ""}).ok());
}

// The ids of a page that the filter passes, newest first.
inline std::vector<std::string> Listed(SolveStore& store, const SolveFilter& filter,
                                       const std::optional<std::string>& tenant = std::nullopt) {
  std::vector<std::string> ids;
  const SolvePage page = store.List({1000, "", std::nullopt, tenant, filter}).value();
  for (const SolveRecord& record : page.records) ids.push_back(record.id);
  return ids;
}

// In a store that was filled by FillForFilters and then migrated.
inline void ExpectFiltersFindThem(SolveStore& store) {
  using Ids = std::vector<std::string>;
  EXPECT_EQ(Listed(store, {.model = "planar"}).size(), 101u);
  EXPECT_EQ(Listed(store, {.model = "human29"}), Ids{"human"});
  EXPECT_EQ(Listed(store, {.model = "own"}), Ids{"own"});
  EXPECT_EQ(Listed(store, {.termination = v1::TERMINATION_ACCEPTABLE}), Ids{"planar0"});
  EXPECT_EQ(Listed(store, {.verdict = v1::VERDICT_WITHIN, .model = "planar"}), Ids{"planar0"});
  EXPECT_EQ(store.Get("unread").value().labels, Labels());
  NewSolve labelled{"labelled", "", "s", ""};
  labelled.labels = {{"sweep", "hills"}};
  ASSERT_TRUE(store.Create(labelled).ok());
  EXPECT_EQ(Listed(store, {.labels = {{"sweep", "hills"}}}), Ids{"labelled"});
}

// Undoes what versions 8 and 9 have beyond version 7; SQL of both engines.
inline constexpr char kBackToVersion7[] =
    "DROP TABLE journals; DROP INDEX solves_queued; ALTER TABLE solves DROP COLUMN priority; ALTER TABLE tenants DROP "
    "COLUMN weight; "
    "DROP TABLE shares; UPDATE schema_version SET version = 7;";

// As version 7 left it: two of red wait, then one of blue.
inline void FillForTurns(SolveStore& store) {
  for (const char* id : {"red1", "red2", "blue1"}) {
    NewSolve solve{id, "", "spec", ""};
    solve.actor.tenant = std::string(id).substr(0, std::string(id).size() - 1);
    ASSERT_TRUE(store.Create(solve).ok());
  }
}

inline void ExpectTurnsAndPriorities(SolveStore& store) {
  EXPECT_EQ(store.Get("red1").value().priority, 0);
  ASSERT_TRUE(store.SetPriority("red2", 1).ok());
  std::vector<std::string> claimed;
  for (int i = 0; i < 3; ++i) {
    const auto claim = store.ClaimNext("agent", kLeaseDuration);
    ASSERT_TRUE(claim.ok() && claim.value().has_value());
    claimed.push_back(claim.value()->record.id);
  }
  EXPECT_EQ(claimed, (std::vector<std::string>{"blue1", "red2", "red1"}));
}

inline const SolveEnd kAnswer{SolveState::kSucceeded, "the result", "", true};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_STORE_STORE_BENCH_H_
