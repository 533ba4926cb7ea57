#include "core/gait/smoothing_continuation.h"

#include <gtest/gtest.h>

#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/power_smoothing.h"

namespace rollgait {
namespace {

GaitRequest Draft(std::optional<double> smoothing) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 8;
  cost::MuscleWork work;
  work.smoothing = smoothing;
  request.costs = {{work, 1e-3},
                   {cost::SquaredTorqueRate{}, 3e-8},
                   {cost::SquaredAcceleration{}, 3e-6},
                   {cost::MuscleEffort{}, 0.05}};
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
}

TEST(PowerSmoothing, IsTheLeastOfAllTermsAndNoneWithoutPowers) {
  GaitRequest request = Draft(3);
  cost::MechanicalWork work;
  work.smoothing = 7;
  request.costs.push_back({work, 1e-3});
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_EQ(LeastSmoothing(spec), 3);
  const GaitSpec smooth = SmoothedBy(5, spec);
  EXPECT_EQ(std::get<cost::MuscleWork>(smooth.costs.front().term).smoothing, 5);
  EXPECT_EQ(std::get<cost::MechanicalWork>(smooth.costs.back().term).smoothing, 7);
  request.costs = {{cost::SquaredTorque{}, 1}};
  EXPECT_EQ(LeastSmoothing(CheckRequest(request).value()), std::nullopt);
}

// A cold solve comes down from much smoothing, and ends in a minimum of what was asked for.
TEST(ReduceSmoothing, EndsInAMinimumOfTheRequest) {
  const GaitSolution solution = Solve(Draft(std::nullopt));
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  ASSERT_GE(solution.meshes.size(), 2u);
  EXPECT_EQ(solution.meshes.front().smoothing, 40);
  EXPECT_EQ(solution.meshes.back().smoothing, 5);
  EXPECT_FALSE(solution.warm_started);
  EXPECT_LE(solution.kkt_error, 1e-6);
  // Started from there the request itself moves no more: its own objective, to the tolerance.
  GaitSpec spec = CheckRequest(Draft(5)).value();
  spec.warm_start = WarmStart{*solution.trajectory, solution.multipliers, solution.added};
  const GaitSolution again = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(again.termination, Termination::kOptimal) << again.message;
  EXPECT_EQ(again.meshes.size(), 1u);
  EXPECT_NEAR(again.objective, solution.objective, 1e-6 * solution.objective);
}

// The less smoothing the more of the energy counts; without any all of it.
TEST(ReduceSmoothing, TheEnergyGrowsTowardsTheUnsmoothedOne) {
  const GaitSolution much = Solve(Draft(40)), little = Solve(Draft(5));
  ASSERT_EQ(much.termination, Termination::kOptimal) << much.message;
  ASSERT_EQ(little.termination, Termination::kOptimal) << little.message;
  EXPECT_EQ(much.meshes.size(), 1u);
  EXPECT_GT(much.costs[0].value, 0);
  const auto hidden = [](const GaitSolution& solution) {
    return 1 - solution.costs[0].value / solution.costs[0].unsmoothed;
  };
  EXPECT_GT(hidden(much), 2 * hidden(little));
  EXPECT_GT(hidden(little), 0);
  EXPECT_EQ(much.costs[1].value, much.costs[1].unsmoothed);
  // With less smoothing gaits are cheaper by the energy that is spent in the end.
  EXPECT_LT(little.costs[0].unsmoothed, much.costs[0].unsmoothed);
}

// Nothing is passed off as the answer if the smoothing asked for is not reached.
TEST(ReduceSmoothing, SaysHowFarItCame) {
  GaitRequest request = Draft(5);
  const GaitSolution whole = Solve(request);
  ASSERT_EQ(whole.termination, Termination::kOptimal) << whole.message;
  request.solver_limits.max_iterations = whole.meshes.front().iterations + 2;
  const GaitSolution cut = Solve(request);
  EXPECT_EQ(cut.termination, Termination::kIterationLimit);
  EXPECT_NE(cut.message.find("It converged with powers smoothed by 40 W, not by 5 W."), std::string::npos)
      << cut.message;
  EXPECT_EQ(cut.meshes.size(), 2u);
}

}  // namespace
}  // namespace rollgait
