#include "server/agent/run_end.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

constexpr int kExit0 = 0;
constexpr int Signalled(int signal) { return signal; }  // wait status of a process that died by a signal

RunFacts With(std::optional<v1::Termination> termination, int wait_status) {
  RunFacts facts;
  facts.process = {wait_status, 1.5, 4096};
  facts.cpu_limit_s = 100;
  if (termination) {
    facts.last.emplace();
    facts.last->mutable_result()->set_termination(*termination);
  }
  return facts;
}

const SolveEnd& End(const std::variant<SolveEnd, Crash>& outcome) { return std::get<SolveEnd>(outcome); }

v1::SolveError::Kind KindOf(const std::variant<SolveEnd, Crash>& outcome) {
  v1::SolveError error;
  EXPECT_TRUE(error.ParseFromString(End(outcome).error));
  return error.kind();
}

TEST(JudgeRun, OnlyAnOptimalResultMayAnswerOthers) {
  const SolveEnd optimal = End(JudgeRun(With(v1::TERMINATION_OPTIMAL, kExit0)));
  EXPECT_EQ(optimal.state, SolveState::kSucceeded);
  EXPECT_TRUE(optimal.reusable);
  const SolveEnd late = End(JudgeRun(With(v1::TERMINATION_TIME_LIMIT, kExit0)));
  EXPECT_EQ(late.state, SolveState::kSucceeded);
  EXPECT_FALSE(late.reusable);
}

TEST(JudgeRun, AResultGetsTheFiguresOfItsProcess) {
  v1::SolveResult result;
  ASSERT_TRUE(result.ParseFromString(End(JudgeRun(With(v1::TERMINATION_OPTIMAL, kExit0))).result));
  EXPECT_EQ(result.cpu_time_s(), 1.5);
  EXPECT_EQ(result.peak_memory_bytes(), 4096);
}

TEST(JudgeRun, ACancelledSolveThatFinishedFirstKeepsItsAnswer) {
  RunFacts facts = With(v1::TERMINATION_OPTIMAL, kExit0);
  facts.cancelled = true;
  EXPECT_EQ(End(JudgeRun(facts)).state, SolveState::kSucceeded);
}

TEST(JudgeRun, ACancelledSolveWithoutAnAnswerIsCancelled) {
  for (const auto& termination : {std::optional<v1::Termination>(), std::optional(v1::TERMINATION_CANCELLED)}) {
    RunFacts facts = With(termination, Signalled(SIGKILL));
    facts.cancelled = true;
    EXPECT_EQ(End(JudgeRun(facts)).state, SolveState::kCancelled);
    EXPECT_EQ(KindOf(JudgeRun(facts)), v1::SolveError::KIND_CANCELLED);
  }
}

TEST(JudgeRun, AStopThatNobodyAskedForIsACrash) {
  const auto outcome = JudgeRun(With(v1::TERMINATION_CANCELLED, kExit0));
  ASSERT_TRUE(std::holds_alternative<Crash>(outcome));
  EXPECT_THAT(std::get<Crash>(outcome).detail, HasSubstr("from outside"));
}

TEST(JudgeRun, KilledAtTheCpuLimitIsATimeLimitKilledBeforeIsACrash) {
  RunFacts facts = With(std::nullopt, Signalled(SIGKILL));
  EXPECT_TRUE(std::holds_alternative<Crash>(JudgeRun(facts)));
  facts.process.cpu_time_s = 100.5;
  EXPECT_EQ(KindOf(JudgeRun(facts)), v1::SolveError::KIND_TIME_LIMIT);
  EXPECT_EQ(KindOf(JudgeRun(With(std::nullopt, Signalled(SIGXCPU)))), v1::SolveError::KIND_TIME_LIMIT);
}

TEST(JudgeRun, AnErrorOfTheSolverIsTheErrorOfTheSolve) {
  RunFacts facts = With(std::nullopt, kExit0);
  facts.last.emplace();
  facts.last->mutable_error()->set_kind(v1::SolveError::KIND_INTERNAL);
  facts.last->mutable_error()->set_message("no");
  EXPECT_EQ(KindOf(JudgeRun(facts)), v1::SolveError::KIND_INTERNAL);
  EXPECT_EQ(End(JudgeRun(facts)).state, SolveState::kFailed);
}

TEST(JudgeRun, OnlyWhoWasKilledBeforeItHadTheRequestNeverBegan) {
  RunFacts facts = With(std::nullopt, Signalled(SIGKILL));
  EXPECT_FALSE(std::get<Crash>(JudgeRun(facts)).began);
  facts.taken = true;
  EXPECT_TRUE(std::get<Crash>(JudgeRun(facts)).began);
  for (const int status : {kExit0, Signalled(SIGSEGV)}) {
    EXPECT_TRUE(std::get<Crash>(JudgeRun(With(std::nullopt, status))).began);
  }
}

TEST(JudgeRun, ExitStatusZeroWithoutAnythingIsACrash) {
  RunFacts facts = With(std::nullopt, kExit0);
  facts.output = "STOP 1";
  const auto outcome = JudgeRun(facts);
  ASSERT_TRUE(std::holds_alternative<Crash>(outcome));
  EXPECT_THAT(std::get<Crash>(outcome).detail, HasSubstr("exit status 0 without a result; it printed: STOP 1"));
}

}  // namespace
}  // namespace rollgait::server
