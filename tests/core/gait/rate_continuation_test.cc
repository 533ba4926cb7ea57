// Squared torque by continuation in the weight of torque rates.
#include "core/gait/rate_continuation.h"

#include <gtest/gtest.h>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"

namespace rollgait {
namespace {

GaitSpec Planar(double slope_degrees) {
  GaitRequest request;
  request.body.model = "planar";
  request.slope = slope_degrees * 3.14159265358979 / 180;
  request.preset = Preset::kTorque;
  return CheckRequest(request).value();
}

GaitSolution FromTheGuess(const GaitSpec& spec, SolveBudget* budget) {
  const auto problem = BuildProblem(spec);
  return SolveOnMeshes(spec, *problem, WalkingGuess(spec, *problem), RequestedMesh(spec), budget);
}

TEST(RateContinuation, IsForSquaredTorqueAlone) {
  EXPECT_TRUE(LeavesRatesFree(Planar(0)));
  EXPECT_FALSE(LeavesRatesFree(WithRates(Planar(0))));
  GaitRequest request;
  request.body.model = "planar";
  for (const Preset preset : {Preset::kTransport, Preset::kHuman}) {
    request.preset = preset;
    EXPECT_FALSE(LeavesRatesFree(CheckRequest(request).value()));
  }
  request.preset.reset();
  request.costs = {{cost::Time{}, 1}};
  EXPECT_FALSE(LeavesRatesFree(CheckRequest(request).value()));
}

// Uphill, where one gait is cheapest, both ways end in it; the rates have no weight left.
TEST(RateContinuation, EndsWhereTheDirectWayEnds) {
  const GaitSpec spec = Planar(10);
  const SolveControl control;
  SolveBudget budget(spec, control);
  const GaitSolution direct = FromTheGuess(spec, &budget);
  ASSERT_EQ(direct.termination, Termination::kOptimal);
  GaitSolution rated = FromTheGuess(WithRates(spec), &budget);
  ASSERT_EQ(rated.termination, Termination::kOptimal);
  EXPECT_GT(rated.objective, 1.001 * direct.objective);
  const size_t before = budget.log().size();
  const GaitSolution released = ReleaseRates(spec, std::move(rated), &budget);
  ASSERT_EQ(released.termination, Termination::kOptimal) << released.message;
  EXPECT_EQ(released.verdict.kind, Verdict::Kind::kWithin);
  EXPECT_EQ(released.costs.size(), 1u);
  EXPECT_GE(budget.log().size(), before + 7);
  EXPECT_NEAR(released.objective, direct.objective, 2e-3 * direct.objective);  // on another mesh
}

// A budget that ends on the way leaves no solution that would pass for one of the spec.
TEST(RateContinuation, StopsWithTheBudget) {
  GaitSpec spec = Planar(10);
  const SolveControl control;
  SolveBudget ample(spec, control);
  GaitSolution rated = FromTheGuess(WithRates(spec), &ample);
  ASSERT_EQ(rated.termination, Termination::kOptimal);
  spec.max_iterations = 1;
  SolveBudget scarce(spec, control);
  EXPECT_EQ(ReleaseRates(spec, std::move(rated), &scarce).termination, Termination::kIterationLimit);
}

}  // namespace
}  // namespace rollgait
