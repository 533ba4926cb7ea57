#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/gait/optimizing_gait_solver.h"

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
  EXPECT_LE(two.objective, one.objective);
  EXPECT_EQ(two.meshes.size(), 2u);
  EXPECT_NE(two.message.find("from 2 starts"), std::string::npos) << two.message;
  EXPECT_EQ(two.objective, again.objective);
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

}  // namespace
}  // namespace rollgait
