// Gaits that version 0.3.0 called accurate although joints left their ranges between nodes, the ground pulled, or a
// foot was hit while it rose: at standard they keep every bound now, since what they violated is added to the problem.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "core/gait/added_constraints.h"
#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

struct Case {
  const char* name;
  double slope_deg, speed;
  Preset preset;
  std::function<void(GaitRequest&)> change;
};

class VerdictOfGaitsTest : public ::testing::TestWithParam<Case> {};

TEST_P(VerdictOfGaitsTest, IsWithinAtStandard) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = GetParam().preset;
  request.slope = GetParam().slope_deg * std::numbers::pi / 180;
  request.motion.speed = GetParam().speed;
  GetParam().change(request);
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), {});
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_TRUE(solution.within_requested_accuracy()) << Describe(solution.verdict.excesses);
}

void Nothing(GaitRequest&) {}

INSTANTIATE_TEST_SUITE_P(
    Planar, VerdictOfGaitsTest,
    ::testing::Values(Case{"KneeAndAnkleBetweenNodes", 20, 1.3, Preset::kTorque, Nothing},
                      Case{"HermiteSimpson", 20, 1.3, Preset::kTorque,
                           [](GaitRequest& r) { r.discretization.scheme = Scheme::kHermiteSimpson; }},
                      Case{"Plastic", 0, 1.3, Preset::kTorque,
                           [](GaitRequest& r) { r.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic; }},
                      // Impulses of heel and forefoot that vanish together.
                      Case{"SoftPlasticUphill", 23, 0.45, Preset::kHuman,
                           [](GaitRequest& r) { r.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic; }},
                      Case{"SlowHuman", 0, 1.0, Preset::kHuman, Nothing},
                      Case{"DownhillHuman", -20, 1.3, Preset::kHuman, Nothing},
                      Case{"FullCycle", 0, 1.3, Preset::kHuman, [](GaitRequest& r) { r.cycle = Cycle::kFull; }},
                      Case{"Transport", -10, 1.3, Preset::kTransport, Nothing}),
    [](const auto& each) { return std::string(each.param.name); });

// Draft is not judged, whatever the gait is worth.
TEST(VerdictOfADraft, IsNone) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 2;
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), {});
  EXPECT_EQ(solution.verdict.kind, Verdict::Kind::kNotJudged);
  EXPECT_FALSE(solution.within_requested_accuracy());
}

// A bound that no mesh of the request can meet: the result says which, and is not within.
TEST(VerdictOfAGait, NamesTheBoundThatIsNotMet) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.bounds[Criterion::kPositionDefect] = 1e-9;
  request.accuracy.max_refinements = 1;
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), {});
  EXPECT_EQ(solution.termination, Termination::kOptimal);
  ASSERT_EQ(solution.verdict.kind, Verdict::Kind::kExceeded);
  EXPECT_EQ(solution.verdict.excesses.front().criterion, Criterion::kPositionDefect);
  EXPECT_NE(solution.message.find("difference of positions after re-integration"), std::string::npos)
      << solution.message;
}

// Refinement ends with a mesh that a solver's memory holds, and says so.
TEST(VerdictOfAGait, SaysThatAFinerMeshWouldBeTooFine) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  request.accuracy.bounds[Criterion::kSlip] = 1e-8;
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), {});
  EXPECT_EQ(solution.verdict.kind, Verdict::Kind::kExceeded);
  EXPECT_NE(solution.message.find("more than 1000 intervals"), std::string::npos) << solution.message;
  ASSERT_GT(solution.meshes.size(), 2u);
  for (const MeshStatistics& mesh : solution.meshes) {
    int total = 0;
    for (const int intervals : mesh.intervals) total += intervals;
    EXPECT_LE(total, kMostIntervals);
  }
}

// Joints that leave their limits between the nodes of one phase are found by name and phase, and once only.
TEST(AddedConstraintsTest, NameJointsAndPhasesThatAreViolated) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  GaitSpec spec = CheckRequest(request).value();
  const int knee = spec.scene.model.Find("knee_r"), n = spec.scene.model.size();
  Trajectory trajectory;
  trajectory.points_per_interval = 2;
  trajectory.point_fractions = {1.0 / 3, 1};
  for (int p = 0; p < 2; ++p) {
    TrajectoryPhase phase;
    phase.node_times = {0.1 * p, 0.1 * p + 0.1};
    phase.node_positions = MatrixX::Zero(n, 2);
    phase.node_velocities = MatrixX::Zero(n, 2);
    phase.point_accelerations = MatrixX::Zero(n, 2);
    phase.point_efforts = MatrixX::Zero(static_cast<int>(spec.scene.model.actuated().size()), 2);
    for (int j = 0; j < n; ++j) {
      const Joint& joint = spec.scene.model.joint(j);
      if (std::isfinite(joint.position_min) && std::isfinite(joint.position_max)) {
        phase.node_positions.row(j).setConstant((joint.position_min + joint.position_max) / 2);
      }
    }
    trajectory.phases.push_back(phase);
  }
  AccuracyReport report;
  AddedConstraints added;
  EXPECT_FALSE(AddViolated(spec, trajectory, report, &added));
  // From its upper end with 1 rad/s and back: it is past its range inside the interval, by 0.025 rad, and at no node.
  TrajectoryPhase& second = trajectory.phases[1];
  second.node_positions.row(knee).setConstant(spec.scene.model.joint(knee).position_max);
  second.node_velocities(knee, 0) = 1;
  second.node_velocities(knee, 1) = -1;
  second.point_accelerations.row(knee).setConstant(-20);
  EXPECT_TRUE(AddViolated(spec, trajectory, report, &added));
  ASSERT_EQ(added.between.size(), 2u);
  EXPECT_TRUE(added.between[0].range.empty());
  EXPECT_EQ(added.between[1].range, std::vector<int>{knee});
  EXPECT_TRUE(added.between[1].velocity.empty() && added.between[1].effort.empty());
  EXPECT_FALSE(AddViolated(spec, trajectory, report, &added));
}

}  // namespace
}  // namespace rollgait
