// Bodies whose left and right differ walk in full cycles, and their mirror images walk in mirror images of these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/gait/added_constraints.h"
#include "core/gait/half_cycle.h"
#include "core/gait/one_sided_start.h"
#include "core/gait/optimizing_gait_solver.h"
#include "tests/core/gait/mirrored_walk.h"
#include "tests/core/gait/motion_residuals.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

GaitRequest Planar() {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kTorque;
  request.motion.speed = 1.2;
  request.discretization.single_support_intervals = 6;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  return request;
}

// A short thigh, a load, a weak knee and a sprung ankle.
GaitRequest OneSided(const std::string& side) {
  GaitRequest request = Planar();
  request.body.segment_lengths = {{"thigh" + side, 0.41}};
  request.body.changes.loads = {{.segment = "shank" + side, .mass = 1, .position = {}}};
  request.body.changes.strengths = {{"knee" + side, 0.6}};
  request.body.changes.springs = {{"ankle" + side, {100, 0, 1}}};
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
}

TEST(OneSidedBody, TakesTheFullCycleByItself) {
  GaitRequest request = OneSided("_l");
  EXPECT_EQ(CheckRequest(request).value().cycle, Cycle::kFull);
  EXPECT_TRUE(CheckRequest(request).value().is_full_by_body);
  EXPECT_EQ(CheckRequest(request).value().phases.size(), 4u);
  request.cycle = Cycle::kFull;
  EXPECT_FALSE(CheckRequest(request).value().is_full_by_body);
  request.cycle = Cycle::kHalf;
  EXPECT_EQ(CheckRequest(request).violations().front().field, "cycle");
  EXPECT_EQ(CheckRequest(Planar()).value().cycle, Cycle::kHalf);
}

TEST(OneSidedBody, KnowsTheSymmetricOne) {
  const GaitRequest request = OneSided("_l");
  EXPECT_NE(CheckRequest(request).value().symmetric, nullptr);
  EXPECT_EQ(CheckRequest(request).value().symmetric->symmetric, nullptr);
}

TEST(OneSidedBody, SeveralStartsHaveTheSymmetricOneAmongThem) {
  GaitRequest request = OneSided("_l");
  const GaitSolution one = Solve(request);
  request.starts = 2;
  const GaitSolution several = Solve(request);
  ASSERT_EQ(several.termination, Termination::kOptimal) << several.message;
  EXPECT_LE(several.objective, one.objective * (1 + 1e-6));  // both end at the scaled KKT error 1e-6
  EXPECT_THAT(several.message, HasSubstr("It was started from"));
  EXPECT_GT(several.meshes.size(), one.meshes.size() + 1);
}

// Every row and bound of the mirrored body's program holds at the mirrored walk as well as at the walk, at the same
// cost.
TEST(OneSidedBody, CanWalkAsItsMirrorImageMirrored) {
  const GaitSpec spec = CheckRequest(OneSided("_l")).value(), other = CheckRequest(OneSided("_r")).value();
  const GaitSolution walk = Solve(OneSided("_l"));
  ASSERT_EQ(walk.termination, Termination::kOptimal) << walk.message;
  const Residuals own = ResidualsAt(spec, {*walk.trajectory, std::nullopt, UsualConstraints(spec)});
  const Residuals mirrored =
      ResidualsAt(other, {MirroredWalk(*walk.trajectory, other), std::nullopt, UsualConstraints(other)});
  EXPECT_LT(own.rows, 1e-5);  // rows of unit size, ten times the tolerance of their violation
  EXPECT_LT(mirrored.rows, 1.001 * own.rows + 1e-9) << mirrored.worst_row;
  EXPECT_LT(mirrored.bounds, own.bounds + 1e-9);
  EXPECT_NEAR(mirrored.objective, own.objective, 1e-12 * own.objective);
}

// From the mirrored walk: from starts of their own the two may come to different local minima, since a cycle of one
// begins where one of the other has its middle (docs/explanation/optimizer.md).
TEST(OneSidedBody, WalksAsItsMirrorImageMirrored) {
  const GaitSolution left = Solve(OneSided("_l"));
  ASSERT_EQ(left.termination, Termination::kOptimal) << left.message;
  GaitSpec spec = CheckRequest(OneSided("_r")).value();
  spec.warm_start = {MirroredWalk(*left.trajectory, spec), std::nullopt, UsualConstraints(spec)};
  const GaitSolution right = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(right.termination, Termination::kOptimal) << right.message;
  EXPECT_TRUE(right.warm_started);
  EXPECT_THAT(left.message, HasSubstr("full cycle"));
  EXPECT_THAT(left.message, HasSubstr("both sides alike"));
  EXPECT_EQ(left.trajectory->cycle, Cycle::kFull);
  // Both end at the scaled KKT error 1e-6.
  EXPECT_NEAR(left.objective, right.objective, 1e-6 * left.objective);
  EXPECT_NEAR(left.trajectory->duration, right.trajectory->duration, 1e-4);
  ASSERT_TRUE(left.events && right.events);
  const GaitEvents &a = *left.events, &b = *right.events;
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    const FootOnGround &mine = a.foot(foot), &other = b.foot(foot == Foot::kRight ? Foot::kLeft : Foot::kRight);
    EXPECT_NEAR(mine.step_length, other.step_length, 1e-3);
    EXPECT_NEAR(mine.step_duration, other.step_duration, 1e-3);
    EXPECT_NEAR(mine.stance, other.stance, 1e-3);
    EXPECT_NEAR(mine.loading, other.loading, 1e-3);
    EXPECT_GT(mine.step_length, 0.2);
  }
  EXPECT_NEAR(a.foot(Foot::kRight).step_length + a.foot(Foot::kLeft).step_length, a.displacement, 1e-12);
  EXPECT_NEAR(a.foot(Foot::kRight).loading + a.foot(Foot::kLeft).loading, a.double_support, 1e-12);
  EXPECT_NEAR(a.StepDurationAsymmetry(), -b.StepDurationAsymmetry(), 2e-3);
  EXPECT_GT(std::abs(a.StepLengthAsymmetry()) + std::abs(a.StanceAsymmetry()), 5e-3);
  // The comparison of each leg with normative data is that of the other leg of the other body; the two are not alike.
  ASSERT_TRUE(left.normative_left && right.normative_left);
  const auto rms = [](const std::optional<NormativeComparison>& leg) {
    return leg->datasets[0].curves[0].distance.rms;
  };
  EXPECT_NEAR(rms(left.normative_left), rms(right.normative), 0.02);  // degrees; as the step lengths
  EXPECT_NEAR(rms(left.normative), rms(right.normative_left), 0.02);
  EXPECT_GT(std::abs(rms(left.normative) - rms(left.normative_left)), 0.1);
}

// What the other body has, by name; a joint that is locked here moves there.
TEST(OneSidedStart, CarriesJointsByName) {
  GaitRequest request = OneSided("_l");
  request.body.locked_joints = {{"ankle_r", 0}};
  const GaitSpec spec = CheckRequest(request).value();
  const std::optional<GaitSpec> step = SymmetricStepOf(spec);
  ASSERT_TRUE(step);
  const Model &whole = step->scene.model, &model = spec.scene.model;
  EXPECT_TRUE(step->scene.symmetric);
  EXPECT_EQ(whole.size(), model.size() + 1);
  EXPECT_EQ(whole.joint(whole.Find("knee_l")).effort_max, whole.joint(whole.Find("knee_r")).effort_max);
  EXPECT_EQ(whole.joint(whole.Find("ankle_l")).stiffness, 0);
  const GaitSolution solved = OptimizingGaitSolver().Solve(*step, SolveControl());
  ASSERT_EQ(solved.termination, Termination::kOptimal) << solved.message;
  const Trajectory both = BothSteps(*spec.symmetric, solved).trajectory;
  const Trajectory start = OneSidedStart(spec, solved).trajectory;
  EXPECT_TRUE(CheckWarmStart(spec, start).empty());
  ASSERT_EQ(start.phases.size(), 4u);
  for (size_t p = 0; p < start.phases.size(); ++p) {
    const TrajectoryPhase &mine = start.phases[p], &theirs = both.phases[p];
    ASSERT_EQ(mine.node_positions.rows(), model.size());
    ASSERT_EQ(mine.point_efforts.rows(), static_cast<int>(model.actuated().size()));
    for (int j = 0; j < model.size(); ++j) {
      const int same = whole.Find(model.joint(j).name);
      EXPECT_EQ(mine.node_positions.row(j), theirs.node_positions.row(same));
      EXPECT_EQ(mine.point_accelerations.row(j), theirs.point_accelerations.row(same));
    }
    for (size_t a = 0; a < model.actuated().size(); ++a) {
      const std::vector<int>& there = whole.actuated();
      const auto same = std::find(there.begin(), there.end(), whole.Find(model.joint(model.actuated()[a]).name));
      EXPECT_EQ(mine.point_efforts.row(static_cast<int>(a)),
                theirs.point_efforts.row(static_cast<int>(same - there.begin())));
    }
  }
  EXPECT_GT(start.phases[1].point_efforts.cwiseAbs().maxCoeff(), 1);
}

// Per metre, two steps cost what one costs.
TEST(SymmetricBody, CostsTheSameInTheFullCycle) {
  GaitRequest request = Planar();
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  request.preset = Preset::kHuman;
  const GaitSolution half = Solve(request);
  request.cycle = Cycle::kFull;
  const GaitSolution full = Solve(request);
  ASSERT_EQ(half.termination, Termination::kOptimal) << half.message;
  ASSERT_EQ(full.termination, Termination::kOptimal) << full.message;
  EXPECT_THAT(full.message, Not(HasSubstr("full cycle")));
  EXPECT_NEAR(full.objective, half.objective, 1e-6 * half.objective);
  EXPECT_NEAR(full.events->StepLengthAsymmetry(), 0, 1e-3);
}

}  // namespace
}  // namespace rollgait
