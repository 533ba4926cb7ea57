#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/slope_continuation.h"
#include "core/validation/normative.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

GaitRequest Draft(double slope) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.slope = slope * kDegree;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 8;
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
}

// Share of the cycle that the left and the right foot stand, from the phases.
double DutyFactor(const GaitSolution& solution, const Scene& scene) {
  double stance = 0;
  for (const TrajectoryPhase& phase : solution.trajectory->phases) {
    bool left = false, right = false;
    for (int c : phase.contacts) (scene.contacts[c].name.starts_with("left") ? left : right) = true;
    stance += (left + right) * phase.duration;
  }
  return stance / (2 * solution.trajectory->duration);
}

TEST(DutyFactor, IsWhatWasPrescribed) {
  GaitRequest request = Draft(0);
  const double free = DutyFactor(Solve(request), CheckRequest(request).value().scene);
  EXPECT_LT(free, 0.6);  // otherwise the bounds below would prove nothing
  request.motion.duty_factor = GaitRequest::Range{0.62, 0.62};
  EXPECT_NEAR(DutyFactor(Solve(request), CheckRequest(request).value().scene), 0.62, 1e-7);
  request.motion.duty_factor = GaitRequest::Range{0.61, 0.65};
  EXPECT_NEAR(DutyFactor(Solve(request), CheckRequest(request).value().scene), 0.61, 1e-5);
}

TEST(Starts, KeepTheCheapestAndSayWhichItWas) {
  GaitRequest request = Draft(0);
  request.preset = Preset::kHuman;
  request.starts = 1;
  const GaitSolution one = Solve(request);
  request.starts = 2;
  const GaitSolution two = Solve(request), again = Solve(request);
  ASSERT_EQ(one.termination, Termination::kOptimal);
  ASSERT_EQ(two.termination, Termination::kOptimal);
  EXPECT_LE(two.objective, (1 + 1e-6) * one.objective) << "to the tolerance of the optimality conditions";
  EXPECT_EQ(two.meshes.size(), 3u);  // one from each start with smooth powers, one with the preset's
  EXPECT_NE(two.message.find("from 2 starts"), std::string::npos) << two.message;
  EXPECT_EQ(two.objective, again.objective);
}

// A mesh is left before its optimum where a finer one is to follow. If that one fails, what is returned is no less
// optimal than it says.
TEST(Refinement, NeverCallsARoughSolutionOptimal) {
  GaitRequest request = Draft(0);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  int converged = 0, limited = 0;
  for (int iterations = 20; iterations <= 100; iterations += 8) {
    request.solver_limits.max_iterations = iterations;
    const GaitSolution solution = Solve(request);
    if (solution.termination == Termination::kOptimal) {
      EXPECT_LE(solution.kkt_error, 1e-6) << iterations << ": " << solution.message;
      ++converged;
    } else {
      EXPECT_NE(solution.verdict.kind, Verdict::Kind::kWithin);
      ++limited;
    }
  }
  EXPECT_GT(converged, 0);
  EXPECT_GT(limited, 0);
}

TEST(Starts, StopWhenTheyAreToldTo) {
  GaitRequest request = Draft(0);
  request.starts = 3;
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    if (info.mesh == 1 && info.index == 2) stop.Request();
  };
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), control);
  EXPECT_EQ(solution.termination, Termination::kCancelled);
  EXPECT_EQ(solution.meshes.size(), 2u);
}

// Continuation and the cold start are two ways to one optimum.
TEST(SlopeContinuation, ReachesWhatTheColdStartFinds) {
  GaitRequest request = Draft(12);  // 5, 10, 12
  request.preset = Preset::kHuman;
  request.starts = 1;
  const GaitSpec spec = CheckRequest(request).value();
  const SolveControl control;
  SolveBudget budget(spec, control);
  const std::optional<GaitSolution> continued = SolveFromLevelGround(spec, &budget);
  ASSERT_TRUE(continued);
  EXPECT_EQ(budget.log().size(), 4u);
  EXPECT_NE(continued->note.find("continuation"), std::string::npos);
  const GaitSolution cold = Solve(request);
  ASSERT_EQ(cold.termination, Termination::kOptimal);
  // Both to a KKT error of 1e-6; as local minima they may differ, the better one then being that of the walk.
  EXPECT_LT(continued->objective, cold.objective * (1 + 1e-5));
}

// Stopped on the way it has no answer, and the log ends with the program that was stopped.
TEST(SlopeContinuation, EndsWithTheBudget) {
  GaitRequest request = Draft(12);
  request.preset = Preset::kHuman;
  request.starts = 1;
  const GaitSpec spec = CheckRequest(request).value();
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    if (info.mesh == 2 && info.index == 1) stop.Request();
  };
  SolveBudget budget(spec, control);
  EXPECT_FALSE(SolveFromLevelGround(spec, &budget));
  ASSERT_EQ(budget.log().size(), 3u);
  EXPECT_EQ(budget.log().back().termination, Termination::kCancelled);
  EXPECT_NEAR(budget.log().back().slope, 10 * std::numbers::pi / 180, 1e-12);
}

TEST(Preset, HumanWalksOnAllSlopes) {
  for (const double slope : {-10.0, 0.0, 10.0}) {
    GaitRequest request = Draft(slope);
    request.preset = Preset::kHuman;
    request.starts = 1;
    const GaitSolution solution = Solve(request);
    EXPECT_EQ(solution.termination, Termination::kOptimal) << slope;
    EXPECT_EQ(solution.costs.size(), 6u);
    for (const CostValue& cost : solution.costs) EXPECT_GT(cost.contribution, 0) << cost.name;
  }
}

// The aims of the project for level walking, at standard accuracy, judged by code that knows nothing of presets.
TEST(Preset, HumanResemblesPeople) {
  GaitRequest request = Draft(0);
  request.preset = Preset::kHuman;
  request.starts = 1;
  request.discretization.single_support_intervals = 16;
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_TRUE(solution.within_requested_accuracy()) << solution.message;
  const auto& people = solution.normative;
  ASSERT_TRUE(people);
  EXPECT_GT(people->stance, 0.58);
  EXPECT_LT(people->stance, 0.64);
  EXPECT_TRUE(people->peaks.two);
  EXPECT_TRUE(people->resting.empty() || people->resting[0].share < 0.1);
  int angles = 0, moments = 0;
  for (const DatasetComparison& set : people->datasets) {
    for (const CurveComparison& curve : set.curves) {
      if (curve.quantity == NormativeQuantity::kAngle) {
        ++angles;
        EXPECT_GT(curve.distance.correlation, 0.9) << set.dataset << " " << curve.joint;
      } else if (curve.quantity == NormativeQuantity::kMoment && curve.joint == "ankle") {
        ++moments;
        EXPECT_GT(curve.distance.correlation, 0.8);
      }
    }
  }
  EXPECT_EQ(angles, 6);
  EXPECT_EQ(moments, 1);
}

}  // namespace
}  // namespace rollgait
