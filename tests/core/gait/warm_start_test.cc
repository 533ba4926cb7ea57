#include "core/gait/warm_start.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

GaitRequest Draft(double slope, double speed = 1.3) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = speed;
  request.slope = slope * kDegree;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 16;
  return request;
}

GaitSolution Solve(const GaitSpec& spec) { return OptimizingGaitSolver().Solve(spec, SolveControl()); }

// The solve of the request from a solution.
GaitSolution SolveFrom(GaitRequest request, const GaitSolution& solution, bool with_multipliers = true) {
  request.warm_start = true;
  GaitSpec spec = CheckRequest(request).value();
  spec.warm_start =
      WarmStart{*solution.trajectory, with_multipliers ? solution.multipliers : std::nullopt, solution.added};
  return Solve(spec);
}

// Minima lie side by side: one of the four ends in another one, 0.27 % from that of the cold start.
TEST(WarmStart, ANeighbourTakesFewerIterationsToTheSameOptimum) {
  int same = 0;
  const GaitSolution level = Solve(CheckRequest(Draft(0)).value());
  ASSERT_EQ(level.termination, Termination::kOptimal);
  EXPECT_FALSE(level.warm_started);
  for (const GaitRequest& request : {Draft(1), Draft(-1), Draft(0, 1.35), Draft(0, 1.25)}) {
    const GaitSolution cold = Solve(CheckRequest(request).value()), warm = SolveFrom(request, level);
    ASSERT_EQ(cold.termination, Termination::kOptimal);
    ASSERT_EQ(warm.termination, Termination::kOptimal);
    EXPECT_TRUE(warm.warm_started && warm.used_multipliers);
    ASSERT_EQ(warm.meshes.size(), 1u);
    EXPECT_LE(3 * warm.meshes[0].iterations, 2 * cold.meshes[0].iterations);
    // Both end where the barrier allows, which moves the objective by its parameter times the bounds that act.
    same += std::abs(warm.objective - cold.objective) < 1e-5 * cold.objective ? 1 : 0;
    EXPECT_NEAR(warm.objective, cold.objective, 5e-3 * cold.objective);
    // Going on from there never ends dearer.
    EXPECT_LT(SolveFrom(request, warm).objective, (1 + 1e-5) * warm.objective);
  }
  EXPECT_GE(same, 3);
}

// With prices of power it starts closer to the bounds: 48 iterations for all four, where those that start further off
// take 77 and the cold ones, from powers smoothed by 40 W, 282.
TEST(WarmStart, NeighboursThatPayForPowerTakeAQuarterOfTheIterations) {
  const auto human = [](double slope, double speed = 1.3) {
    GaitRequest request = Draft(slope, speed);
    request.preset = Preset::kHuman;
    return request;
  };
  const GaitSolution level = Solve(CheckRequest(human(0)).value());
  ASSERT_EQ(level.termination, Termination::kOptimal);
  int with_start = 0, without = 0;
  for (const GaitRequest& request : {human(1), human(-1), human(0, 1.35), human(0, 1.25)}) {
    const GaitSolution cold = Solve(CheckRequest(request).value()), warm = SolveFrom(request, level);
    ASSERT_EQ(warm.termination, Termination::kOptimal);
    ASSERT_EQ(warm.meshes.size(), 1u);
    with_start += warm.meshes[0].iterations;
    for (const MeshStatistics& mesh : cold.meshes) without += mesh.iterations;
    EXPECT_NEAR(warm.objective, cold.objective, 1e-2 * cold.objective) << "a minimum, if not the same";
  }
  EXPECT_LE(4 * with_start, without);
}

TEST(WarmStart, TheSolutionItselfIsFoundAtOnceWithItsMultipliers) {
  const GaitRequest request = Draft(2);
  const GaitSolution cold = Solve(CheckRequest(request).value());
  const GaitSolution warm = SolveFrom(request, cold), bare = SolveFrom(request, cold, false);
  ASSERT_EQ(warm.termination, Termination::kOptimal);
  ASSERT_EQ(bare.termination, Termination::kOptimal);
  EXPECT_FALSE(bare.used_multipliers);
  EXPECT_LT(warm.meshes[0].iterations, bare.meshes[0].iterations);
  EXPECT_NEAR(warm.objective, cold.objective, 1e-5 * cold.objective);
}

TEST(WarmStart, AnotherMeshTakesInterpolatedMotionAndMultipliers) {
  const GaitSolution coarse = Solve(CheckRequest(Draft(0)).value());
  GaitRequest request = Draft(1);
  request.discretization.single_support_intervals = 24;
  const GaitSolution cold = Solve(CheckRequest(request).value()), warm = SolveFrom(request, coarse);
  ASSERT_EQ(warm.termination, Termination::kOptimal);
  EXPECT_TRUE(warm.used_multipliers);
  EXPECT_EQ(warm.meshes[0].intervals, cold.meshes[0].intervals);
  EXPECT_LT(warm.meshes[0].iterations, cold.meshes[0].iterations);
}

TEST(WarmStart, AtStandardAccuracyTheMeshOfTheNeighbourIsTaken) {
  GaitRequest request = Draft(0);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  const GaitSolution level = Solve(CheckRequest(request).value());
  ASSERT_TRUE(level.within_requested_accuracy());
  ASSERT_GT(level.meshes.size(), 1u);  // otherwise its mesh would be the one that was asked for
  request.slope = 0.5 * kDegree;
  const GaitSolution warm = SolveFrom(request, level);
  ASSERT_EQ(warm.termination, Termination::kOptimal);
  EXPECT_TRUE(warm.within_requested_accuracy());
  EXPECT_EQ(warm.meshes[0].intervals, level.meshes.back().intervals);
}

TEST(WarmStart, AStartThatLeadsNowhereIsSaid) {
  const GaitRequest request = Draft(0);
  GaitSolution nonsense = Solve(CheckRequest(request).value());
  nonsense.trajectory->phases[0].node_velocities(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const GaitSolution solution = SolveFrom(request, nonsense);
  ASSERT_EQ(solution.termination, Termination::kOptimal);
  EXPECT_FALSE(solution.warm_started);
  EXPECT_NE(solution.message.find("the warm start did not converge"), std::string::npos);
  EXPECT_EQ(solution.meshes.size(), 2u);
}

TEST(CheckWarmStart, NamesWhatDiffers) {
  const GaitSolution level = Solve(CheckRequest(Draft(0)).value());
  const auto refusal = [&level](const GaitRequest& request) {
    const Violations violations = CheckWarmStart(CheckRequest(request).value(), *level.trajectory);
    return violations.empty() ? "" : violations[0].field + ": " + violations[0].message;
  };
  EXPECT_EQ(refusal(Draft(5, 1.1)), "");
  GaitRequest request = Draft(0);
  request.cycle = Cycle::kFull;
  EXPECT_EQ(
      refusal(request),
      "warm_start: its solution is one step (CYCLE_HALF, which its mirror image completes), this request asks for "
      "two steps (CYCLE_FULL); give `cycle` CYCLE_HALF, or start from a solve of the cycle that this request asks "
      "for");
  request.cycle.reset();
  request.body.changes.strengths["knee_l"] = 0.5;
  EXPECT_NE(refusal(request).find("because left and right of its body differ"), std::string::npos);
  request = Draft(0);
  request.discretization.scheme = Scheme::kRadau3;
  EXPECT_NE(refusal(request).find("another discretization.scheme"), std::string::npos);
  request = Draft(0);
  request.body.feet = FootShape::kTwoEllipsoids;
  EXPECT_NE(refusal(request).find("phase"), std::string::npos) << refusal(request);
  request = Draft(0);
  request.body.model = "human29";
  EXPECT_NE(refusal(request).find("9 joints, the model of this request has 29"), std::string::npos) << refusal(request);
}

TEST(CheckRequest, AWarmStartIsTheOnlyStart) {
  GaitRequest request = Draft(0);
  request.warm_start = true;
  request.preset = Preset::kHuman;
  EXPECT_EQ(CheckRequest(request).value().starts, 1);
  request.starts = 2;
  const Result<GaitSpec> refused = CheckRequest(request);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.violations()[0].field, "starts");
}

}  // namespace
}  // namespace rollgait
