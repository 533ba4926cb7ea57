#include "core/gait/mesh_continuation.h"

#include <gtest/gtest.h>

#include "core/gait/artefact.h"
#include "core/gait/build_problem.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

GaitRequest Fine(int intervals) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = intervals;
  request.discretization.double_support_intervals = intervals / 2;
  request.costs = {{cost::SquaredTorque{}, 1}, {cost::SquaredTorqueRate{}, 1e-4}};
  return request;
}

GaitSpec Check(const GaitRequest& request) { return CheckRequest(request).value(); }

GaitSolution Solve(const GaitSpec& spec) { return OptimizingGaitSolver().Solve(spec, SolveControl()); }

std::vector<int> Totals(const GaitSolution& solution) {
  std::vector<int> totals;
  for (const MeshStatistics& mesh : solution.meshes) {
    totals.push_back(mesh.intervals[0] + mesh.intervals[1]);
  }
  return totals;
}

TEST(CoarseStart, HalvesUntilFewEnoughAreLeft) {
  EXPECT_EQ(CoarseStart(Check(Fine(24))), std::nullopt);  // 36 in all
  GaitRequest request = Fine(100);
  request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
  const auto coarse = CoarseStart(Check(request));
  ASSERT_TRUE(coarse);
  // 50 + 100, 25 + 50, 13 + 25 are too many, in the order of the phases.
  EXPECT_EQ(coarse->phases[0].intervals, 7);
  EXPECT_EQ(coarse->phases[1].intervals, 13);
  EXPECT_EQ(coarse->bounds[Criterion::kSlip], kInfinity);
  EXPECT_EQ(coarse->bounds[Criterion::kGap], kInfinity);
  EXPECT_EQ(coarse->max_refinements, 0);
  EXPECT_EQ(coarse->kkt_tolerance, Check(request).kkt_tolerance);
}

// As many phases as a request may have, of one interval each: there is nothing to halve, though they are more than 36.
TEST(CoarseStart, LeavesEveryPhaseAnInterval) {
  GaitSpec spec = Check(Fine(8));
  spec.phases.resize(40, spec.phases.front());
  for (GaitSpec::Phase& phase : spec.phases) phase.intervals = 1;
  EXPECT_EQ(CoarseStart(spec), std::nullopt);
  spec.phases.front().intervals = 3;
  const auto coarse = CoarseStart(spec);
  ASSERT_TRUE(coarse);
  for (const GaitSpec::Phase& phase : coarse->phases) EXPECT_EQ(phase.intervals, 1);
}

// The intermediate mesh has intervals twice as long as the request's, but for six at both ends of both phases; with
// rates alone but for the two that are known to be the request's at each end.
TEST(SolveFromCoarse, HasShortIntervalsAtTheEndsOfPhases) {
  GaitRequest request = Fine(96);
  request.costs = {{cost::SquaredTorque{}, 1}};
  EXPECT_EQ(Solve(Check(request)).meshes[1].intervals, (std::vector<int>{6 + 18 + 6, 6 + 42 + 6}));
  request = Fine(192);
  const GaitSolution solution = Solve(Check(request));
  EXPECT_EQ(Totals(solution), (std::vector<int>{36, 80, 148, 288}));
  // 1, 1, 2, 4 … 4, 2, 1, 1, then 1, 1, 2 … 2, 1, 1 of the requested ones.
  EXPECT_EQ(solution.meshes[1].intervals, (std::vector<int>{3 + 22 + 3, 3 + 46 + 3}));
  EXPECT_EQ(solution.meshes[2].intervals, (std::vector<int>{2 + 46 + 2, 2 + 94 + 2}));
}

// The end is a solution of the spec's own NLP. Started from there it is found again, or left for a cheaper one beside
// it, by less than 0.1 %: valleys of squared torque are flat.
TEST(SolveFromCoarse, EndsInASolutionOnTheRequestedMesh) {
  const GaitSpec spec = Check(Fine(96));
  const GaitSolution solution = Solve(spec);
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  GaitSpec again = spec;
  again.warm_start = WarmStart{*solution.trajectory, solution.multipliers, solution.added};
  const GaitSolution repeated = Solve(again);
  ASSERT_EQ(repeated.termination, Termination::kOptimal) << repeated.message;
  EXPECT_EQ(repeated.meshes.size(), 1u);
  EXPECT_LT(repeated.objective, (1 + 1e-6) * solution.objective);
  EXPECT_GT(repeated.objective, (1 - 1e-3) * solution.objective);
}

// The intermediate mesh, whose intervals are shorter at the ends of phases, starts with a barrier of 1e-3: fewer than
// 92 iterations in all, where a warm start far from the bounds takes 104. The requested one, which has none that are
// shorter, starts at 1e-4: 82, else 200.
TEST(SolveFromCoarse, MeshesStartCloseToTheirBounds) {
  int intermediate = 0, arriving = 0;
  for (const int intervals : {60, 72, 80, 90, 96}) {
    const GaitSolution solution = Solve(Check(Fine(intervals)));
    ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
    ASSERT_EQ(solution.meshes.size(), 3u);
    intermediate += solution.meshes[1].iterations;
    arriving += solution.meshes[2].iterations;
  }
  EXPECT_LE(intermediate, 92);
  EXPECT_LE(arriving, 120);
}

// With powers it starts ten times closer: 45 iterations in all, 303 from as far as a neighbour.
TEST(SolveFromCoarse, WithPowersTheRequestedMeshStartsClosestOfAll) {
  int arriving = 0;
  for (const int intervals : {120, 144, 168, 192}) {
    GaitRequest request = Fine(intervals);
    request.costs.clear();
    request.preset = Preset::kHuman;
    request.starts = 1;
    const GaitSolution solution = Solve(Check(request));
    ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
    arriving += solution.meshes.back().iterations;
  }
  EXPECT_LE(arriving, 90);
}

// One on the way to 120 + 60 intervals goes round in circles. It is given up, and the next one starts from the one
// before it.
TEST(SolveFromCoarse, LeavesOutAMeshThatLeadsNowhere) {
  GaitRequest request = Fine(120);
  request.costs.clear();
  request.preset = Preset::kTransport;
  request.starts = 1;
  const GaitSolution solution = Solve(Check(request));
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_EQ(Totals(solution).back(), 180);
  for (const MeshStatistics& mesh : solution.meshes) EXPECT_LE(mesh.iterations, 200);
}

// The smoothing of powers is reduced on the coarsest mesh, where it is cheap and steps succeed; all finer ones are
// solved with the spec's.
TEST(SolveFromCoarse, ClimbsWithTheSmoothingOfTheSpec) {
  GaitRequest request = Fine(60);
  request.costs.clear();
  request.preset = Preset::kTransport;
  request.starts = 1;
  const GaitSpec spec = Check(request);
  const GaitSolution solution = Solve(spec);
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  int coarsest = 0, smooth = 0;
  for (const MeshStatistics& mesh : solution.meshes) {
    const bool first = mesh.intervals == solution.meshes.front().intervals;
    if (first) ++coarsest;
    if (mesh.smoothing > 5) {
      ++smooth;
      EXPECT_TRUE(first);
    }
  }
  EXPECT_GE(smooth, 1);
  EXPECT_GT(coarsest, smooth);
  EXPECT_EQ(Totals(solution).back(), 90);
}

// A start whose feet slip at more than half the speed is no start, and nothing is solved from there.
TEST(SolveFromCoarse, RefusesAStartBeyondRefinement) {
  const GaitSpec spec = Check(Fine(48));
  GaitSolution start = Solve(*CoarseStart(spec));
  ASSERT_EQ(start.termination, Termination::kOptimal) << start.message;
  start.accuracy->max_slip = 0.51 * start.speed;
  ASSERT_TRUE(IsBeyondRefinement(spec, start));
  const SolveControl control;
  SolveBudget budget(spec, control);
  const GaitSolution refused = SolveFromCoarse(spec, *BuildProblem(spec), start, &budget);
  EXPECT_EQ(refused.termination, Termination::kNumericalDifficulty);
  EXPECT_TRUE(budget.log().empty());
  start.accuracy->max_slip = 0.49 * start.speed;
  EXPECT_EQ(SolveFromCoarse(spec, *BuildProblem(spec), start, &budget).termination, Termination::kOptimal);
}

// Where the iterations end on the way, no answer of a coarse mesh is passed off as the request's.
TEST(SolveFromCoarse, GivesNoCoarseAnswer) {
  GaitRequest request = Fine(48);
  const GaitSolution whole = Solve(Check(request));
  ASSERT_EQ(whole.termination, Termination::kOptimal) << whole.message;
  request.solver_limits.max_iterations = whole.meshes[0].iterations + 2;
  const GaitSolution cut = Solve(Check(request));
  EXPECT_EQ(cut.termination, Termination::kIterationLimit);
  EXPECT_FALSE(cut.within_requested_accuracy());
}

}  // namespace
}  // namespace rollgait
