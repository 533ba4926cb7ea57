#include "server/service/solve_message.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

EventPtr Iteration(int64_t sequence, int skipped = 0) {
  v1::SolveEvent event;
  event.set_sequence(sequence);
  event.set_skipped_count(skipped);
  event.mutable_iteration()->set_index(static_cast<int>(sequence));
  return std::make_shared<v1::SolveEvent>(event);
}

EventPtr Change(int64_t sequence) {
  v1::SolveEvent event;
  event.set_sequence(sequence);
  event.mutable_state_change()->set_state(v1::SOLVE_STATE_RUNNING);
  return std::make_shared<v1::SolveEvent>(event);
}

TEST(SolveNameTest, NamesAndIds) {
  EXPECT_EQ(SolveName("abc"), "solves/abc");
  EXPECT_EQ(SolveId("solves/abc").value(), "abc");
  for (const char* bad : {"", "abc", "solves/", "solve/abc", "/solves/abc"}) {
    EXPECT_EQ(SolveId(bad).error().code, ErrorCode::kNotFound) << bad;
  }
}

TEST(ToSolveTest, CarriesEveryField) {
  SolveRecord record;
  record.id = "a";
  v1::SolveSpec spec;
  spec.set_slope_rad(0.2);
  record.spec = spec.SerializeAsString();
  record.state = SolveState::kFailed;
  record.create_time_us = 1'500'000;
  record.end_time_us = 2'000'001;
  record.attempts = 3;
  record.from_cache = true;
  record.last_sequence = 9;
  v1::SolveError error;
  error.set_kind(v1::SolveError::KIND_CRASH);
  record.error = error.SerializeAsString();
  const v1::Solve solve = ToSolve(record).value();
  EXPECT_EQ(solve.name(), "solves/a");
  EXPECT_EQ(solve.spec().slope_rad(), 0.2);
  EXPECT_EQ(solve.state(), v1::SOLVE_STATE_FAILED);
  EXPECT_EQ(solve.create_time().seconds(), 1);
  EXPECT_EQ(solve.create_time().nanos(), 500'000'000);
  EXPECT_FALSE(solve.has_start_time());
  EXPECT_EQ(solve.end_time().nanos(), 1000);
  EXPECT_FALSE(solve.has_result());
  EXPECT_EQ(solve.error().kind(), v1::SolveError::KIND_CRASH);
  EXPECT_EQ(solve.attempts(), 3);
  EXPECT_TRUE(solve.from_cache());
  EXPECT_EQ(solve.last_sequence(), 9);
  EXPECT_FALSE(solve.has_outcome());
  record.error = "\xff\xff";
  EXPECT_EQ(ToSolve(record).error().code, ErrorCode::kInternal);
}

TEST(ToSolveTest, TellsTheOutcomeWithoutTheResult) {
  SolveRecord record;
  record.id = "a";
  record.state = SolveState::kSucceeded;
  record.termination = v1::TERMINATION_OPTIMAL;
  record.verdict = v1::VERDICT_EXCEEDED;
  const v1::Solve solve = ToSolve(record).value();
  EXPECT_FALSE(solve.has_result());
  EXPECT_EQ(solve.outcome().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(solve.outcome().verdict(), v1::VERDICT_EXCEEDED);
}

TEST(ToSolveBytesTest, AreThoseOfTheMessage) {
  SolveRecord record;
  v1::SolveSpec spec;
  spec.set_slope_rad(0.2);
  record.spec = spec.SerializeAsString();
  record.state = SolveState::kSucceeded;
  record.last_sequence = 9;
  v1::SolveResult result;
  result.set_message(std::string(300, 'm'));         // its length takes two bytes
  for (size_t length = 1; length < 100; ++length) {  // the head's string grows at different places
    record.id = std::string(length, 'a');
    record.state = length % 2 == 0 ? SolveState::kSucceeded : SolveState::kRunning;
    for (const std::string& stored : {std::string(), result.SerializeAsString()}) {
      record.result = stored;
      const SolveBytes bytes = ToSolveBytes(record).value();
      EXPECT_EQ(bytes.result, stored);
      v1::Solve solve;
      ASSERT_TRUE(solve.ParseFromString(bytes.head + bytes.result));
      const bool ended = record.state == SolveState::kSucceeded;
      EXPECT_EQ(solve.has_result(), ended && !stored.empty());
      EXPECT_EQ(solve.has_intermediate(), !ended && !stored.empty()) << "while it runs that is no result";
      EXPECT_EQ(solve.SerializeAsString(), ToSolve(record).value().SerializeAsString());
    }
  }
  record.error = "\xff\xff";
  EXPECT_EQ(ToSolveBytes(record).error().code, ErrorCode::kInternal);
}

TEST(MergeIterationsTest, LeavesOutIteratesBeforeTheLast) {
  const auto iterate = [](int index) {
    v1::SolveEvent event;
    event.mutable_iterate()->set_index(index);
    return std::make_shared<v1::SolveEvent>(event);
  };
  const auto merged = MergeIterations({Iteration(1), iterate(1), Iteration(2), iterate(2), Iteration(3), Change(4)});
  ASSERT_EQ(merged.size(), 4u);
  EXPECT_EQ(merged[0]->sequence(), 2);
  EXPECT_EQ(merged[0]->skipped_count(), 1);
  EXPECT_EQ(merged[1]->iterate().index(), 2);
  EXPECT_EQ(merged[2]->sequence(), 3);
  EXPECT_EQ(merged[3]->sequence(), 4);
}

TEST(MergeIterationsTest, KeepsTheLastOfEachRunAndAllElse) {
  const auto merged = MergeIterations({Iteration(1), Iteration(2, 3), Iteration(3), Change(4), Iteration(5), Change(6),
                                       Change(7), Iteration(8), Iteration(9)});
  ASSERT_EQ(merged.size(), 6u);
  EXPECT_EQ(merged[0]->sequence(), 3);
  EXPECT_EQ(merged[0]->skipped_count(), 5);  // 1, 2, and the three that were merged into 2 before
  EXPECT_EQ(merged[1]->sequence(), 4);
  EXPECT_EQ(merged[2]->sequence(), 5);
  EXPECT_EQ(merged[2]->skipped_count(), 0);
  EXPECT_EQ(merged[3]->sequence(), 6);
  EXPECT_EQ(merged[4]->sequence(), 7);
  EXPECT_EQ(merged[5]->sequence(), 9);
  EXPECT_EQ(merged[5]->skipped_count(), 1);
  EXPECT_TRUE(MergeIterations({}).empty());
}

}  // namespace
}  // namespace rollgait::server
