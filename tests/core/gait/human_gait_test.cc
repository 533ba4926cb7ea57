// Gaits of bodies beyond the planar walker with one-piece feet, from the built-in start.
#include <gtest/gtest.h>

#include <numbers>

#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

GaitRequest Draft(const char* model, double slope_deg, int single, int both) {
  GaitRequest request;
  request.body.model = model;
  request.slope = slope_deg * std::numbers::pi / 180;
  request.motion.speed = 1.3;
  request.discretization.single_support_intervals = single;
  request.discretization.double_support_intervals = both;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), {});
}

void ExpectWalk(const GaitSolution& solution) {
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_LE(solution.kkt_error, 1e-6);
  EXPECT_NEAR(solution.speed, 1.3, 1e-6);
  EXPECT_GT(solution.step_length, 0.3);
  EXPECT_LT(solution.step_length, 0.8);
}

class HumanGait : public ::testing::TestWithParam<int> {};

// The paper's three slopes, with torque and a little torque rate.
TEST_P(HumanGait, WalksInSpace) {
  GaitRequest request = Draft("human29", GetParam(), 20, 10);
  request.costs = {{cost::SquaredTorque{}, std::nullopt}, {cost::SquaredTorqueRate{}, 1e-4}};
  const GaitSolution solution = Solve(request);
  ExpectWalk(solution);
  ASSERT_TRUE(solution.accuracy && solution.trajectory);
  EXPECT_LT(solution.accuracy->max_gap, 2e-3);
  EXPECT_LT(solution.accuracy->periodicity_error, 1e-6);
  // Sideways the walk comes back: the pelvis ends at the mirror image of where it began, facing the mirror image.
  const Model model = CheckRequest(request).value().scene.model;
  const MatrixX& first = solution.trajectory->phases.front().node_positions;
  const MatrixX& last = solution.trajectory->phases.back().node_positions;
  for (const char* joint : {"base_y", "base_yaw", "base_roll", "trunk_bending"}) {
    const int j = model.Find(joint);
    EXPECT_NEAR(last(j, last.cols() - 1), -first(j, 0), 1e-6) << joint;
  }
  EXPECT_NEAR(last(model.Find("hip_adduction_l"), last.cols() - 1), first(model.Find("hip_adduction_r"), 0), 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Slopes, HumanGait, ::testing::Values(-10, 0, 10));

// Heel strike, foot flat, heel off: in the flat phase the foot stands still.
TEST(HumanGait, FeetOfTwoSurfacesRollFromHeelToToe) {
  GaitRequest request = Draft("planar", 0, 16, 8);
  request.body.feet = FootShape::kTwoEllipsoids;
  const GaitSolution solution = Solve(request);
  ExpectWalk(solution);
  ASSERT_TRUE(solution.trajectory);
  ASSERT_EQ(solution.trajectory->phases.size(), 4u);
  const TrajectoryPhase& flat = solution.trajectory->phases[2];
  const Model model = CheckRequest(request).value().scene.model;
  VectorX pitch = flat.node_positions.row(model.Find("base_pitch"));
  for (const auto& [joint, sign] : {std::pair("hip_l", -1), {"knee_l", 1}, {"ankle_l", -1}}) {
    pitch += sign * flat.node_positions.row(model.Find(joint)).transpose();
  }
  EXPECT_LT(pitch.maxCoeff() - pitch.minCoeff(), 1e-3);
}

// One stiff knee: a limp, in a full cycle.
TEST(HumanGait, OneStiffKneeLimps) {
  GaitRequest request = Draft("planar", 0, 10, 5);
  request.body.locked_joints = {{"knee_r", 0.1}};
  request.cycle = Cycle::kFull;
  const GaitSolution solution = Solve(request);
  ExpectWalk(solution);
  ASSERT_TRUE(solution.trajectory);
  EXPECT_EQ(solution.trajectory->phases.size(), 4u);
  EXPECT_GT(std::abs(solution.trajectory->phases[1].duration - solution.trajectory->phases[3].duration), 1e-3);
}

}  // namespace
}  // namespace rollgait
