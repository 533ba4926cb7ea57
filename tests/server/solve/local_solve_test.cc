#include "server/solve/local_solve.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <sstream>

#include "rollgait/v1/solve.pb.h"
#include "tests/server/solve/scripted_solver.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

class LocalSolveTest : public ::testing::Test {
 protected:
  LocalExit Solve(const std::string& json, Termination termination, Verdict::Kind verdict = Verdict::Kind::kNotJudged) {
    ScriptedSolver solver([&](const GaitSpec& spec, const SolveControl& control) {
      slope_ = spec.slope;
      IterationInfo iteration;
      iteration.index = 17;
      control.observer(iteration);
      GaitSolution solution = EndedWith(termination);
      solution.verdict.kind = verdict;
      return solution;
    });
    return SolveLocally(json, solver, stop_, out_, progress_);
  }

  StopFlag stop_;
  std::ostringstream out_, progress_;
  double slope_ = 99;
};

TEST_F(LocalSolveTest, PrintsTheResultAsJson) {
  EXPECT_EQ(Solve(R"({"model": {"name": "planar"}, "slopeRad": 0.1})", Termination::kOptimal), kLocalSolved);
  EXPECT_EQ(slope_, 0.1);
  v1::SolveResult result;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(out_.str(), &result).ok());
  EXPECT_EQ(result.termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_GT(result.peak_memory_bytes(), 0);
  EXPECT_THAT(progress_.str(), HasSubstr("   17  f"));
}

TEST_F(LocalSolveTest, NoSolutionHasItsOwnExitCode) {
  EXPECT_EQ(Solve(R"({"model": {"name": "planar"}})", Termination::kInfeasible), kLocalNoSolution);
  EXPECT_THAT(out_.str(), HasSubstr("TERMINATION_INFEASIBLE"));
}

TEST_F(LocalSolveTest, AMissedBoundHasItsOwnExitCode) {
  const std::string json = R"({"model": {"name": "planar"}})";
  EXPECT_EQ(Solve(json, Termination::kOptimal, Verdict::Kind::kWithin), kLocalSolved);
  EXPECT_EQ(Solve(json, Termination::kOptimal, Verdict::Kind::kNotJudged), kLocalSolved);
  EXPECT_EQ(Solve(json, Termination::kOptimal, Verdict::Kind::kExceeded), kLocalMissesBound);
  EXPECT_EQ(Solve(json, Termination::kAcceptable, Verdict::Kind::kExceeded), kLocalMissesBound);
  EXPECT_EQ(Solve(json, Termination::kTimeLimit, Verdict::Kind::kExceeded), kLocalMissesBound);
  EXPECT_EQ(Solve(json, Termination::kTimeLimit, Verdict::Kind::kWithin), kLocalSolved);
  EXPECT_EQ(Solve(json, Termination::kTimeLimit, Verdict::Kind::kNotJudged), kLocalNoSolution);
}

TEST_F(LocalSolveTest, EveryViolationIsPrinted) {
  EXPECT_EQ(Solve(R"({"model": {"name": "horse"}, "slopeRad": 3})", Termination::kOptimal), kLocalBadRequest);
  EXPECT_THAT(progress_.str(), HasSubstr("model.name: "));
  EXPECT_THAT(progress_.str(),
              HasSubstr("slope_rad: 3 rad (171.887 deg) is outside [-0.785398163, 0.785398163] rad (-45 to 45 deg)"));
  EXPECT_EQ(out_.str(), "");
}

TEST_F(LocalSolveTest, UnknownFieldsAndBrokenJsonAreRefused) {
  EXPECT_EQ(Solve(R"({"modle": {}})", Termination::kOptimal), kLocalBadRequest);
  EXPECT_THAT(progress_.str(), HasSubstr("modle"));
  EXPECT_EQ(Solve("{", Termination::kOptimal), kLocalBadRequest);
}

}  // namespace
}  // namespace rollgait::server
