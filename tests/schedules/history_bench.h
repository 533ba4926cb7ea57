#ifndef ROLLGAIT_TESTS_SCHEDULES_HISTORY_BENCH_H_
#define ROLLGAIT_TESTS_SCHEDULES_HISTORY_BENCH_H_

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/schedules/history_model.h"

namespace rollgait::server {

// A store that does what the test says.
class HistoryBench : public ::testing::Test {
 protected:
  // The solve "a", which waits.
  void SetUp() override {
    solves_ = {{.number = 1, .id = "a", .key = "k", .tag = "t", .state = 1}};
    Log("a", "queued");
    Commit({StoreCall::Kind::kCreate, {"t"}});
    ASSERT_EQ(Violation(), "");
  }

  SeenSolve& a() { return solves_.front(); }
  // Writes an event.
  void Log(const std::string& id, const std::string& what) {
    for (SeenSolve& solve : solves_) {
      if (solve.id != id) continue;
      logs_[solve.number].push_back({++solve.last_sequence, what});
      ++solve.held_events;
    }
  }
  void Commit(StoreCall call) {
    model_.Begin(call, now_);
    model_.Committed(call, now_, solves_, [this](int64_t number, int64_t after) { return EventsOf(number, after); });
  }
  std::vector<SeenEvent> EventsOf(int64_t number, int64_t after) {
    std::vector<SeenEvent> events;
    for (const SeenEvent& event : logs_[number]) {
      if (event.sequence > after) events.push_back(event);
    }
    return events;
  }
  void Claim(const std::string& owner = "agent") {
    a().state = 2;
    a().owner = owner;
    a().epoch += 1;
    Log("a", "running");
    Commit({.kind = StoreCall::Kind::kClaim, .owner = owner, .lease_us = 1000});
    ASSERT_EQ(Violation(), "");
  }
  StoreCall Leased(StoreCall::Kind kind) const {
    const SeenSolve& seen = solves_.front();
    return {.kind = kind, .leases = {{"a", seen.owner, seen.epoch}}, .events = {{}}, .result = "r"};
  }
  void Succeed(const std::string& result = "r") {
    const StoreCall call = Leased(StoreCall::Kind::kFinish);
    a().state = 3;
    a().owner = "";
    a().result = result;
    Log("a", "finished");
    Commit(call);
  }
  std::string Violation() const { return model_.violation().value_or(""); }
  void Expect(const std::string& words) const { EXPECT_NE(Violation().find(words), std::string::npos) << Violation(); }

  HistoryModel model_;
  std::vector<SeenSolve> solves_;
  std::map<int64_t, std::vector<SeenEvent>> logs_;
  int64_t now_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_HISTORY_BENCH_H_
