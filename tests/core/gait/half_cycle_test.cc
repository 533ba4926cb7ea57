// Full cycles that start from one step and its mirror image.
#include "core/gait/half_cycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/gait/optimizing_gait_solver.h"
#include "tests/core/gait/motion_residuals.h"

namespace rollgait {
namespace {

GaitRequest Full(const std::string& model, FootShape feet, GaitRequest::TouchDown touch_down) {
  GaitRequest request;
  request.body.model = model;
  request.body.feet = feet;
  request.cycle = Cycle::kFull;
  request.preset = Preset::kTorque;
  request.ground_contact.touch_down = touch_down;
  request.discretization.single_support_intervals = 8;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  return request;
}

GaitRequest Planar() { return Full("planar", FootShape::kOneEllipsoid, GaitRequest::TouchDown::kSmooth); }

bool HasHalf(const GaitRequest& request) { return HalfCycleOf(CheckRequest(request).value()).has_value(); }

TEST(HalfCycleOf, IsTheRequestForOneStep) {
  const GaitSpec full = CheckRequest(Planar()).value();
  GaitRequest request = Planar();
  request.cycle = Cycle::kHalf;
  const GaitSpec asked = CheckRequest(request).value();
  const std::optional<GaitSpec> half = HalfCycleOf(full);
  ASSERT_TRUE(half);
  EXPECT_EQ(half->cycle, Cycle::kHalf);
  ASSERT_EQ(half->phases.size(), asked.phases.size());
  for (size_t p = 0; p < asked.phases.size(); ++p) {
    EXPECT_EQ(half->phases[p].contacts, asked.phases[p].contacts);
    EXPECT_EQ(half->phases[p].intervals, asked.phases[p].intervals);
  }
  EXPECT_FALSE(HalfCycleOf(asked));
}

TEST(HalfCycleOf, IsEmptyWhereLeftAndRightDiffer) {
  EXPECT_TRUE(HasHalf(Planar()));
  GaitRequest request = Planar();
  request.limits.joint_velocity = {{"knee_l", 5}, {"knee_r", 5}};
  EXPECT_TRUE(HasHalf(request));
  request.limits.joint_velocity = {{"knee_l", 5}};
  EXPECT_FALSE(HasHalf(request));
  request = Planar();
  request.limits.joint_position = {{"knee_r", {0, 1}}};
  EXPECT_FALSE(HasHalf(request));
  request = Planar();
  request.limits.joint_effort = {{"hip_r", {-50, 50}}};
  EXPECT_FALSE(HasHalf(request));
  request = Planar();
  request.costs = {{cost::SquaredTorque{{{"hip_l", 2}, {"hip_r", 2}}}, 1}};
  EXPECT_TRUE(HasHalf(request));
  request.costs = {{cost::SquaredTorque{{{"hip_l", 2}, {"hip_r", 1}}}, 1}};
  EXPECT_FALSE(HasHalf(request));
  request.costs = {{cost::SquaredTorque{}, 1}, {cost::Tracking{{{"hip_l", {0, 0.1, 0.2, 0.1}, {}}}}, 1}};
  EXPECT_FALSE(HasHalf(request));
  // A posture that is held is that of both steps.
  using Channel = cost::Tracking::Channel;
  request.costs = {{cost::SquaredTorque{}, 1}, {cost::Tracking{{Channel{"base_pitch", {0.1, 0.1}, 1}}}, 1}};
  EXPECT_TRUE(HasHalf(request));
  // Where the base is held forward or to the side, the second step is not what the first one is.
  request.costs.back().term = cost::Tracking{{Channel{"base_x", {0, 0}, 1}}};
  EXPECT_FALSE(HasHalf(request));
  GaitRequest in_space = request;
  in_space.body.model = "human29";
  in_space.costs.back().term = cost::Tracking{{Channel{"base_y", {0, 0}, 1}}};
  EXPECT_FALSE(HasHalf(in_space));
  in_space.costs.back().term = cost::Tracking{{Channel{"base_roll", {0, 0}, 1}}};
  EXPECT_TRUE(HasHalf(in_space));
  request.costs.back().term = cost::Tracking{{Channel{"knee_l", {0.1, 0.1}, 1}}};
  EXPECT_FALSE(HasHalf(request));
  request.costs.back().term = cost::Tracking{{Channel{"knee_l", {0.1, 0.1}, 1}, Channel{"knee_r", {0.1, 0.1}, 1}}};
  EXPECT_TRUE(HasHalf(request));
  request.costs.back().term = cost::Tracking{{Channel{"knee_l", {0.1, 0.1}, 1}, Channel{"knee_r", {0.1, 0.1}, 2}}};
  EXPECT_FALSE(HasHalf(request));
  request = Planar();
  request.preset = Preset::kHuman;
  EXPECT_TRUE(HasHalf(request));
  request = Planar();
  request.phases = {{{{"left_foot", "right_foot"}, 4, {}, {}},
                     {{"left_foot"}, 8, {}, {}},
                     {{"left_foot", "right_foot"}, 4, {}, {}},
                     {{"right_foot"}, 8, {}, {}}}};
  EXPECT_TRUE(HasHalf(request));
  (*request.phases)[3].intervals = 9;
  EXPECT_FALSE(HasHalf(request));
  request = Planar();
  request.body.locked_joints = {{"ankle_l", 0}};
  EXPECT_FALSE(HasHalf(request));
}

struct Case {
  const char* model;
  FootShape feet;
  GaitRequest::TouchDown touch_down;
};

class BothStepsOf : public ::testing::TestWithParam<Case> {};

// Every row and bound of the program for two steps, with the constraints of one step mirrored, holds at the two steps
// as well as those of the program for one step hold at it, at the same cost.
TEST_P(BothStepsOf, AreAMotionOfTheFullCycleAtTheSameCost) {
  GaitRequest request = Full(GetParam().model, GetParam().feet, GetParam().touch_down);
  // Rates leave no sharp forces, which a program evaluates off its points.
  request.costs = {{cost::SquaredTorque{}, 1}, {cost::SquaredTorqueRate{}, 1e-4}};
  const GaitSpec full = CheckRequest(request).value();
  const GaitSpec half = HalfCycleOf(full).value();
  GaitSolution step = OptimizingGaitSolver().Solve(half, SolveControl());
  ASSERT_EQ(step.termination, Termination::kOptimal) << step.message;
  // An edge of a pyramid adds a row that it must find on the other foot, too.
  step.added.between.resize(half.phases.size());
  const int stance = half.phases.back().contacts.front();
  const bool in_space = full.scene.model.Find(JointRole::kBaseLateral) >= 0;
  if (in_space) step.added.between.back().friction = {{stance, 5}, {stance, 50}};
  // So does a pair of bodies that is not its own mirror image.
  const std::vector<BodyPair>& pairs = full.scene.pairs;
  step.added.separated.clear();
  std::vector<int> separated;
  for (int p = 0; p < static_cast<int>(pairs.size()) && separated.empty(); ++p) {
    const int image = pairs[static_cast<size_t>(p)].mirror_pair;
    if (image == p) continue;
    step.added.separated = {p};
    separated = {std::min(p, image), std::max(p, image)};
  }
  const WarmStart both = BothSteps(full, step);
  EXPECT_TRUE(CheckWarmStart(full, both.trajectory).empty());
  EXPECT_FALSE(both.multipliers);
  EXPECT_EQ(both.added.separated, separated);

  const Residuals of_one = ResidualsAt(half, {*step.trajectory, std::nullopt, step.added});
  const Residuals of_both = ResidualsAt(full, both);
  EXPECT_LT(of_one.rows, 1e-3);
  EXPECT_LT(of_both.rows, 1.001 * of_one.rows + 1e-6) << of_both.worst_row;
  // The displacement of both is twice that of one, and so is what it is beyond its bound, which the solver moves.
  EXPECT_LT(of_both.bounds, 2.001 * of_one.bounds + 1e-9);
  EXPECT_NEAR(of_both.objective, of_one.objective, 1e-9 * of_one.objective);
  if (!in_space) return;
  const std::vector<FrictionEdge>& edges = both.added.Edges(static_cast<int>(full.phases.size()) - 1);
  const int other = full.scene.contacts[static_cast<size_t>(stance)].mirror_contact;
  EXPECT_EQ(edges, (std::vector<FrictionEdge>{{other, 22}, {other, 67}}));
}

INSTANTIATE_TEST_SUITE_P(Bodies, BothStepsOf,
                         ::testing::Values(Case{"planar", FootShape::kOneEllipsoid, GaitRequest::TouchDown::kPlastic},
                                           Case{"planar", FootShape::kTwoEllipsoids, GaitRequest::TouchDown::kSmooth},
                                           Case{"human29", FootShape::kTwoEllipsoids, GaitRequest::TouchDown::kSmooth},
                                           Case{"human29", FootShape::kOneEllipsoid,
                                                GaitRequest::TouchDown::kPlastic}));

// The first program is that of one step; the last one, of both, has little left to find.
TEST(FullCycle, BeginsWithOneStep) {
  const GaitRequest request = Planar();
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_EQ(solution.trajectory->cycle, Cycle::kFull);
  EXPECT_FALSE(solution.warm_started);
  ASSERT_EQ(solution.meshes.size(), 2u);
  EXPECT_EQ(solution.meshes.front().intervals.size(), 2u);
  EXPECT_EQ(solution.meshes.back().intervals.size(), 4u);
  EXPECT_LE(solution.meshes.back().iterations, 10);
  EXPECT_NEAR(solution.objective, solution.meshes.front().objective, 1e-6 * solution.objective);
}

// Request 74 of seed 7 of bench/verdict_audit: unequal steps cost 5 % less, and from the mirror image the solver gets
// nowhere.
TEST(FullCycle, LeavesASymmetricGaitThatIsNoMinimum) {
  GaitRequest request;
  request.body.model = "human29";
  request.body.sex = Sex::kMale;
  request.body.stature = 1.58;
  request.body.mass = 116;
  request.preset = Preset::kTorque;
  request.motion.speed = 0.75;
  request.cycle = Cycle::kFull;
  request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_TRUE(solution.within_requested_accuracy()) << solution.message;
  const auto image = std::find_if(solution.meshes.begin(), solution.meshes.end(),
                                  [](const MeshStatistics& mesh) { return mesh.intervals.size() == 4; });
  ASSERT_NE(image, solution.meshes.begin());
  ASSERT_EQ(image + 2, solution.meshes.end()) << "once more from the image, and not from a guess";
  EXPECT_EQ(image[1].intervals, image->intervals);
  EXPECT_LT(solution.objective, 0.97 * image[-1].objective);
}

// Of two sides that differ nothing is known of the second step.
TEST(FullCycle, OfAnUnequalBodyIsSolvedAsAWhole) {
  GaitRequest request = Planar();
  request.limits.joint_velocity = {{"knee_l", 12}};
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
  ASSERT_FALSE(solution.meshes.empty());
  EXPECT_EQ(solution.meshes.front().intervals.size(), 4u);
}

}  // namespace
}  // namespace rollgait
