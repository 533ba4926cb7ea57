#include "core/gait/parameter_continuation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/gait/request_check.h"

namespace rollgait {
namespace {

GaitRequest AnyRequest() {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kHuman;
  return request;
}

// A continuation from 0 to 10 whose steps begin with 4 and are halved. What it solves converges where it is no farther
// than `reach` from the last solution; the solution's objective is its value.
class ParameterContinuationTest : public testing::Test {
 protected:
  ParameterContinuationTest() : spec_(CheckRequest(AnyRequest()).value()) {
    control_.stop = &stop_;
    start_.termination = Termination::kOptimal;
    start_.note = " A note.";
    continuation_ = {.from = 0,
                     .to = 10,
                     .first_step = 4,
                     .least_step = 1,
                     .advance = [](double at, double step) { return std::min(10.0, at + step); },
                     .shorten = [](double step) { return step / 2; },
                     .solve =
                         [this](double value, const GaitSolution& last) {
                           tried_.push_back(value);
                           if (stops_.count(value) > 0) stop_.Request();
                           GaitSolution solution;
                           const bool converges = value - last.objective <= reach_;
                           solution.termination = converges ? Termination::kOptimal : Termination::kIterationLimit;
                           solution.objective = value;
                           return solution;
                         }};
  }

  ContinuationEnd Run() {
    SolveBudget budget(spec_, control_);
    return Follow(continuation_, start_, &budget);
  }

  GaitSpec spec_;
  SolveControl control_;
  StopFlag stop_;
  GaitSolution start_;
  ParameterContinuation continuation_;
  double reach_ = 4;
  std::set<double> stops_;
  std::vector<double> tried_;
};

TEST_F(ParameterContinuationTest, ArrivesAtTheRequestItself) {
  const ContinuationEnd end = Run();
  EXPECT_EQ(tried_, (std::vector<double>{4, 8, 10}));
  EXPECT_EQ(end.reached, 10);
  EXPECT_EQ(end.last.objective, 10);
  EXPECT_FALSE(end.failed);
}

TEST_F(ParameterContinuationTest, IsThereAlreadyWhereNothingIsLeftToChange) {
  continuation_.from = 10;
  const ContinuationEnd end = Run();
  EXPECT_TRUE(tried_.empty());
  EXPECT_EQ(end.reached, 10);
  EXPECT_FALSE(end.failed);
}

// A step that was shortened stays short.
TEST_F(ParameterContinuationTest, ShortensAStepThatDoesNotConverge) {
  reach_ = 2.5;
  const ContinuationEnd end = Run();
  EXPECT_EQ(tried_, (std::vector<double>{4, 2, 4, 6, 8, 10}));
  EXPECT_FALSE(end.failed);
}

TEST_F(ParameterContinuationTest, GivesUpBelowTheLeastStepAndSaysWhatFailed) {
  reach_ = 0.5;
  const ContinuationEnd end = Run();
  EXPECT_EQ(tried_, (std::vector<double>{4, 2, 1}));
  EXPECT_EQ(end.reached, 0);
  ASSERT_TRUE(end.failed);
  EXPECT_EQ(end.failed_at, 1);
  EXPECT_EQ(end.failed->termination, Termination::kIterationLimit);
  EXPECT_EQ(end.last.termination, Termination::kOptimal);
}

TEST_F(ParameterContinuationTest, StopsWhereTheBudgetEndsInAStepThatDoesNotConverge) {
  reach_ = 2.5;
  stops_ = {4};
  const ContinuationEnd end = Run();
  EXPECT_EQ(tried_, (std::vector<double>{4}));
  ASSERT_TRUE(end.failed);
  EXPECT_EQ(end.failed_at, 4);
}

TEST_F(ParameterContinuationTest, HandsOnTheNoteOfItsStart) {
  EXPECT_EQ(Run().last.note, start_.note);
  reach_ = 0.5;
  EXPECT_EQ(Run().failed->note, start_.note);
}

}  // namespace
}  // namespace rollgait
