#include "core/gait/mesh_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

// A walk on a coarse mesh, which slips between its nodes, and the bounds that its mesh is to be refined for.
class MeshRefinementTest : public ::testing::Test {
 protected:
  MeshRefinementTest() {
    GaitRequest request;
    request.body.model = "planar";
    request.motion.speed = 1.3;
    request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    spec_ = CheckRequest(request).value();
    const GaitSolution solution = OptimizingGaitSolver().Solve(*spec_, {});
    trajectory_ = solution.trajectory;
    report_ = *solution.accuracy;
    mesh_ = RequestedMesh(*spec_);
  }
  Mesh Refined(double max_slip, bool stalled) {
    spec_->bounds[Criterion::kSlip] = max_slip;
    spec_->bounds[Criterion::kGap] = 1;
    return RefineMesh(mesh_, *spec_, *trajectory_, report_, stalled);
  }

  std::optional<GaitSpec> spec_;
  std::optional<Trajectory> trajectory_;
  AccuracyReport report_;
  Mesh mesh_;
};

TEST_F(MeshRefinementTest, CutsIntervalsThatSlip) {
  const Mesh finer = Refined(1e-3, false);
  ASSERT_EQ(finer.fractions.size(), mesh_.fractions.size());
  size_t kept = 0, cut = 0;
  for (size_t p = 0; p < finer.fractions.size(); ++p) {
    EXPECT_NEAR(std::accumulate(finer.fractions[p].begin(), finer.fractions[p].end(), 0.0), 1, 1e-12);
    const double before = mesh_.fractions[p].front();
    for (double length : finer.fractions[p]) ++(length < 0.9 * before ? cut : kept);
  }
  EXPECT_GT(cut, 0u);
  EXPECT_GT(kept, 0u);
}

// One interval misses one bound: it alone is cut, the more the further it is off, whichever of the measures it is.
TEST_F(MeshRefinementTest, FollowsEveryMeasureOfAnInterval) {
  using enum Criterion;
  spec_->bounds = StandardBounds();
  spec_->bounds[kGap] = 1;  // measured anew, by its drift
  const size_t place = 2;   // of the second phase
  const size_t interval = mesh_.fractions[0].size() + place;
  for (const Criterion criterion :
       {kSlip, kPenetration, kOverlap, kPositionDefect, kVelocityDefect, kPull, kFriction, kEnergy}) {
    size_t before = 1;
    for (const double excess : {0.5, 1.1, 1e6}) {
      report_.intervals.assign(report_.intervals.size(), CriterionValues());
      report_.intervals[interval][criterion] = excess * spec_->bounds[criterion];
      const Mesh finer = RefineMesh(mesh_, *spec_, *trajectory_, report_, false);
      EXPECT_EQ(finer.fractions[0], mesh_.fractions[0]);
      const size_t parts = finer.fractions[1].size() - mesh_.fractions[1].size() + 1;
      EXPECT_EQ(parts == 1, excess < 0.8) << TraitsOf(criterion).field << " " << excess;
      EXPECT_NEAR(finer.fractions[1][place], mesh_.fractions[1][place] / static_cast<double>(parts), 1e-12);
      EXPECT_GE(parts, before);
      before = parts;
    }
    EXPECT_EQ(before, 8u);
  }
}

// Bodies are kept 1 mm further apart at the points than they must be: an overlap of 3 mm is a dip of 4, and it is to be
// at most 1 (half of it, for safety). Its ratio to a bound of 1 µm would ask for the most parts.
TEST_F(MeshRefinementTest, CountsAnOverlapBeyondTheClearance) {
  spec_->bounds = StandardBounds();
  spec_->bounds[Criterion::kGap] = 1;
  const size_t interval = mesh_.fractions[0].size() + 2;
  report_.intervals.assign(report_.intervals.size(), CriterionValues());
  report_.intervals[interval][Criterion::kOverlap] = 3e-3;
  const Mesh finer = RefineMesh(mesh_, *spec_, *trajectory_, report_, false);
  EXPECT_EQ(finer.fractions[1].size(), mesh_.fractions[1].size() + 2);  // √(4/0.5) = 2.8: three parts
}

// An interval that could not be integrated, and all after it, have no measures: nothing is known to be good there.
TEST_F(MeshRefinementTest, CutsWhatWasNotMeasured) {
  spec_->bounds = StandardBounds();
  spec_->bounds[Criterion::kGap] = 1;
  report_.intervals.assign(mesh_.fractions[0].size(), CriterionValues());
  const Mesh finer = RefineMesh(mesh_, *spec_, *trajectory_, report_, false);
  EXPECT_EQ(finer.fractions[0], mesh_.fractions[0]);
  EXPECT_EQ(finer.fractions[1].size(), 4 * mesh_.fractions[1].size());
}

// With an explicit method a foot that begins to slip in one interval slips in all after it. That interval is cut, the
// others do not add to the slip; collocation, of which an interval's slip is its own, cuts what is measured.
TEST_F(MeshRefinementTest, CutsWhereTheSlipOfAnExplicitMethodBegins) {
  spec_->bounds = StandardBounds();
  spec_->bounds[Criterion::kGap] = spec_->bounds[Criterion::kSlip] = 1;
  report_.intervals.assign(report_.intervals.size(), CriterionValues());
  const int place = 2, forward = spec_->scene.model.Find(JointRole::kBaseForward), s = trajectory_->points_per_interval;
  TrajectoryPhase& phase = trajectory_->phases[1];
  const double slip = 2;  // m/s, from the end of that interval on
  const double length = phase.node_times[place + 1] - phase.node_times[place];
  phase.point_accelerations.row(forward).segment(place * s, s).array() += slip / length;
  for (int k = place + 1; k < phase.node_velocities.cols(); ++k) phase.node_velocities(forward, k) += slip;
  const size_t first = mesh_.fractions[0].size(), count = mesh_.fractions[1].size();
  for (size_t k = place; k < count; ++k) report_.intervals[first + k][Criterion::kSlip] = slip;
  const auto cut_intervals = [&](Scheme scheme) {
    spec_->scheme = scheme;
    const Mesh finer = RefineMesh(mesh_, *spec_, *trajectory_, report_, false);
    EXPECT_EQ(finer.fractions[0], mesh_.fractions[0]);
    EXPECT_EQ(finer.fractions[1][place], mesh_.fractions[1][place] / (scheme == Scheme::kRadau2 ? 2 : 3));
    size_t cut = 0, next = 0;
    for (const double fraction : mesh_.fractions[1]) {
      const double ratio = fraction / finer.fractions[1][next];
      next += static_cast<size_t>(std::lround(ratio));
      cut += ratio > 1.5 ? 1 : 0;
    }
    return cut;
  };
  EXPECT_EQ(cut_intervals(Scheme::kShootingConstant), 1u);
  EXPECT_EQ(cut_intervals(Scheme::kRadau2), count - place);
}

TEST_F(MeshRefinementTest, CutsWholePhasesWhenItHasStalled) {
  const Mesh finer = Refined(1e-3, false), stalled = Refined(1e-3, true);
  for (size_t p = 0; p < finer.fractions.size(); ++p) {
    const double before = mesh_.fractions[p].front();
    const bool touched = finer.fractions[p].size() > mesh_.fractions[p].size();
    const double longest = *std::max_element(stalled.fractions[p].begin(), stalled.fractions[p].end());
    EXPECT_NEAR(longest, touched ? before / 2 : before, 1e-12) << p;
    EXPECT_GE(stalled.fractions[p].size(), finer.fractions[p].size());
    EXPECT_NEAR(std::accumulate(stalled.fractions[p].begin(), stalled.fractions[p].end(), 0.0), 1, 1e-12);
  }
}

TEST_F(MeshRefinementTest, LeavesWhatIsGoodEnough) {
  for (const bool stalled : {false, true}) EXPECT_EQ(Refined(100, stalled).fractions, mesh_.fractions);
}

// Half as many intervals come first, and what is returned is the solution on the mesh that was asked for.
TEST(FineMesh, IsReachedByWayOfACoarserOne) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 30;
  request.discretization.double_support_intervals = 9;
  std::vector<int> meshes;
  SolveControl control;
  control.observer = [&meshes](const IterationInfo& info) {
    if (info.index == 0) meshes.push_back(info.mesh);
  };
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(request).value(), control);
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_EQ(meshes, (std::vector<int>{0, 1}));
  ASSERT_EQ(solution.meshes.size(), 2u);
  std::vector<int> coarse = solution.meshes[0].intervals, fine = solution.meshes[1].intervals;
  std::sort(coarse.begin(), coarse.end());
  std::sort(fine.begin(), fine.end());
  EXPECT_EQ(coarse, (std::vector<int>{5, 15}));
  EXPECT_EQ(fine, (std::vector<int>{9, 30}));
  EXPECT_LT(solution.meshes[1].iterations, solution.meshes[0].iterations);
  EXPECT_EQ(solution.objective, solution.meshes[1].objective);
  EXPECT_GT(solution.meshes[0].max_slip, 0);
}

}  // namespace
}  // namespace rollgait
