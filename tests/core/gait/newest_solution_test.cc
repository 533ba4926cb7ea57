// What a search that is stopped, or whose time is up, ends with.
#include "core/gait/newest_solution.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/gait/judge_solution.h"
#include "tests/core/gait/planar_errors.h"

namespace rollgait {
namespace {

struct Taken : SolutionSink {
  void Take(const GaitSolution& solution) override { all.push_back(solution); }
  std::vector<GaitSolution> all;
};

// Refined at least once, with a smoothing of powers that is reduced.
GaitRequest Refined() {
  GaitRequest request = Planar(0, Preset::kTransport, 12);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  request.accuracy.estimate_errors = false;
  return request;
}

GaitSolution Search(const GaitRequest& request, SolutionSink* sink,
                    const std::function<void(const IterationInfo&)>& observer = {}, const StopFlag* stop = nullptr) {
  SolveControl control;
  control.solutions = sink;
  control.observer = observer;
  control.stop = stop;
  return SolvePlanar(request, control);
}

const auto& Angles(const GaitSolution& solution) { return solution.trajectory->phases.at(0).node_positions; }

TEST(NewestSolution, TheLastOneIsTheAnswerAndNothingChanges) {
  Taken taken;
  const GaitSolution watched = Search(Refined(), &taken), unwatched = Search(Refined(), nullptr);
  ASSERT_TRUE(Converged(watched.termination)) << watched.message;
  EXPECT_EQ(watched.objective, unwatched.objective);
  ASSERT_GE(taken.all.size(), 2u);
  EXPECT_EQ(taken.all.back().objective, watched.objective);
  EXPECT_EQ(Angles(taken.all.back()), Angles(watched));
  EXPECT_EQ(taken.all.back().verdict.kind, watched.verdict.kind);
  EXPECT_NE(taken.all.front().objective, watched.objective);
  for (const GaitSolution& solution : taken.all) {
    EXPECT_TRUE(Converged(solution.termination) && solution.trajectory);
    EXPECT_NE(solution.verdict.kind, Verdict::Kind::kNotJudged);
    EXPECT_GT(solution.wall_time, 0);
  }
}

// From the first iteration after a solution on: with the flag, or with the time that passes.
TEST(NewestSolution, AStopLeavesIt) {
  Taken taken;
  StopFlag stop;
  const GaitSolution solution = Search(
      Refined(), &taken,
      [&](const IterationInfo&) {
        if (!taken.all.empty()) stop.Request();
      },
      &stop);
  EXPECT_EQ(solution.termination, Termination::kCancelled);
  ASSERT_EQ(taken.all.size(), 1u);
  ASSERT_TRUE(solution.trajectory);
  EXPECT_EQ(Angles(solution), Angles(taken.all[0]));
  EXPECT_EQ(solution.objective, taken.all[0].objective);
  EXPECT_EQ(solution.verdict.kind, taken.all[0].verdict.kind);
  EXPECT_GT(solution.meshes.size(), taken.all[0].meshes.size()) << "all programs are listed";
  ASSERT_FALSE(solution.unmet_constraints.empty()) << "its powers are those of a start";
  EXPECT_EQ(solution.unmet_constraints[0].name, "power smoothing");
  EXPECT_NEAR(solution.unmet_constraints[0].violation, 40 - 5, 1) << "W";
  EXPECT_NE(solution.message.find("newest solution of a program that converged"), std::string::npos);
}

TEST(NewestSolution, ATimeLimitLeavesIt) {
  GaitRequest request = Refined();
  request.solver_limits.max_wall_time = 4;
  Taken taken;
  const GaitSolution solution = Search(request, &taken, [&](const IterationInfo&) {
    if (!taken.all.empty()) std::this_thread::sleep_for(std::chrono::seconds(4));
  });
  EXPECT_EQ(solution.termination, Termination::kTimeLimit);
  ASSERT_EQ(taken.all.size(), 1u);
  EXPECT_EQ(Angles(solution), Angles(taken.all[0]));
  EXPECT_EQ(solution.verdict.kind, taken.all[0].verdict.kind);
  EXPECT_NE(solution.verdict.kind, Verdict::Kind::kNotJudged);
  EXPECT_NE(solution.message.find("time limit"), std::string::npos) << solution.message;
}

// Nothing has converged: the last iterate, as no solution.
TEST(NewestSolution, WithoutOneNothingIsJudged) {
  StopFlag stop;
  const GaitSolution solution = Search(
      Refined(), nullptr,
      [&](const IterationInfo& info) {
        if (info.index == 2) stop.Request();
      },
      &stop);
  EXPECT_EQ(solution.termination, Termination::kCancelled);
  EXPECT_EQ(solution.verdict.kind, Verdict::Kind::kNotJudged);
}

// The steps on the way to a full cycle are no answers to it.
TEST(NewestSolution, IsOfTheCycleThatWasAskedFor) {
  GaitRequest request = Planar(5, Preset::kTorque, 12);
  request.accuracy.estimate_errors = false;
  request.cycle = Cycle::kFull;
  Taken taken;
  const GaitSolution solution = Search(request, &taken);
  ASSERT_TRUE(Converged(solution.termination)) << solution.message;
  ASSERT_FALSE(taken.all.empty());
  EXPECT_GT(solution.meshes.size(), taken.all.size());
  for (const GaitSolution& one : taken.all) {
    EXPECT_EQ(one.trajectory->cycle, Cycle::kFull);
    EXPECT_EQ(one.meshes.front().cycle, Cycle::kHalf) << "the programs of the step are listed, too";
  }
}

// Once a level has its errors they are what is left, not a finer level without.
TEST(NewestSolution, HasTheErrorsOfItsLevel) {
  GaitRequest request = Planar(0, Preset::kTorque, 8);
  request.accuracy.max_error = MaxError{.angle = 1e-9};
  Taken taken;
  StopFlag stop;
  const GaitSolution solution = Search(
      request, &taken,
      [&](const IterationInfo&) {
        if (!taken.all.empty() && taken.all.back().errors) stop.Request();
      },
      &stop);
  EXPECT_EQ(solution.termination, Termination::kCancelled);
  ASSERT_TRUE(solution.errors) << solution.message;
  EXPECT_EQ(solution.errors->is_within_max_error, false);
  EXPECT_EQ(solution.errors->objective, taken.all.back().errors->objective);
  EXPECT_NE(solution.message.find("not reached"), std::string::npos) << solution.message;
}

TEST(NewestSolution, IsNeverOneThatSaysLess) {
  GaitRequest request = Planar(0, Preset::kTransport, 8);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  request.accuracy.max_error = MaxError{.angle = 0.01};
  Taken taken;
  const GaitSolution solution = Search(request, &taken);
  ASSERT_TRUE(solution.errors) << solution.message;
  const auto is_within = [](const GaitSolution& one) { return one.verdict.kind == Verdict::Kind::kWithin; };
  int with_errors = 0, without = 0;
  for (size_t i = 1; i < taken.all.size(); ++i) {
    const GaitSolution &before = taken.all[i - 1], &after = taken.all[i];
    const double smoother = after.meshes.back().smoothing - before.meshes.back().smoothing;
    EXPECT_LE(smoother, 1e-9) << i;
    if (smoother < 0) continue;
    EXPECT_TRUE(is_within(after) || !is_within(before)) << i;
    const bool is_as_good = is_within(before) == is_within(after);
    EXPECT_TRUE(after.errors || !before.errors || !is_as_good) << i;
    ++(after.errors ? with_errors : without);
  }
  EXPECT_GE(with_errors, 2);
  EXPECT_GE(without, 1);
}

}  // namespace
}  // namespace rollgait
