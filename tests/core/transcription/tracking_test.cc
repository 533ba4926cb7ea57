// A planar walk that tracks a reference follows it.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr int kKnots = 21;

// Lean of the trunk that the walker would not choose, periodic over the half cycle as the mirror image demands.
double Lean(double fraction) { return 0.15 + 0.05 * std::cos(2 * M_PI * fraction); }

GaitRequest CoarseWalk() {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.2;
  request.discretization.double_support_intervals = 2;
  request.discretization.single_support_intervals = 5;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.accuracy.max_refinements = 0;
  request.costs.push_back({cost::SquaredTorque{}, 1.0});
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  const Result<GaitSpec> spec = CheckRequest(request);
  EXPECT_TRUE(spec.ok());
  GaitSolution solution = OptimizingGaitSolver().Solve(spec.value(), {});
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  return solution;
}

double WorstDeviation(const Trajectory& trajectory, int joint) {
  double worst = 0;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    for (size_t k = 0; k < phase.node_times.size(); ++k) {
      const double lean = phase.node_positions(joint, static_cast<int>(k));
      worst = std::max(worst, std::abs(lean - Lean(phase.node_times[k] / trajectory.duration)));
    }
  }
  return worst;
}

TEST(Tracking, ALargeWeightMakesTheWalkFollow) {
  const GaitRequest free_walk = CoarseWalk();
  GaitRequest tracking_walk = free_walk;
  cost::Tracking tracking;
  tracking.channels.push_back({"base_pitch", {}, std::nullopt});
  for (int i = 0; i < kKnots; ++i) tracking.channels[0].positions.push_back(Lean(i / (kKnots - 1.0)));
  tracking_walk.costs.emplace_back().term = tracking;
  tracking_walk.costs.back().weight = 1e6;
  const int pitch = CheckRequest(free_walk).value().scene.model.Find("base_pitch");
  ASSERT_GE(pitch, 0);

  const GaitSolution free_solution = Solve(free_walk), tracked = Solve(tracking_walk);
  EXPECT_GT(WorstDeviation(*free_solution.trajectory, pitch), 0.05);
  EXPECT_LT(WorstDeviation(*tracked.trajectory, pitch), 0.02);

  // Reported on its own, and paid for with torque.
  ASSERT_EQ(tracked.costs.size(), 2u);
  EXPECT_EQ(tracked.costs[1].name, "tracking");
  EXPECT_EQ(tracked.costs[1].unit, "rad² s");
  EXPECT_GT(tracked.costs[1].value, 0);
  EXPECT_LT(tracked.costs[1].value, 0.02 * 0.02 * tracked.trajectory->duration);
  EXPECT_GT(tracked.costs[0].contribution, free_solution.costs[0].contribution);
  EXPECT_NEAR(tracked.objective, tracked.costs[0].contribution + tracked.costs[1].contribution,
              1e-9 * tracked.objective);
}

}  // namespace
}  // namespace rollgait
