// Whole gaits on feet of superellipsoids.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gait/optimizing_gait_solver.h"
#include "core/models/foot.h"

namespace rollgait {
namespace {

GaitRequest Request() {
  GaitRequest request;
  request.body.model = "planar";
  request.body.feet = FootShape::kTwoEllipsoids;
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  return request;
}

GaitRequest WithExponent(double exponent) {
  GaitRequest request = Request();
  request.body.changes.foot_exponents = {{"heel", exponent}, {"forefoot", exponent}};
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
}

// Another class, another way to every number, the same walk.
TEST(SuperellipsoidFeetGait, WithExponentOneItIsThatOfTheEllipsoids) {
  const GaitSolution ellipsoids = Solve(Request()), ones = Solve(WithExponent(1));
  ASSERT_EQ(ellipsoids.termination, Termination::kOptimal) << ellipsoids.message;
  ASSERT_EQ(ones.termination, Termination::kOptimal) << ones.message;
  EXPECT_NEAR(ones.objective, ellipsoids.objective, 1e-8 * ellipsoids.objective);
  ASSERT_EQ(ones.trajectory->phases.size(), ellipsoids.trajectory->phases.size());
  for (size_t p = 0; p < ones.trajectory->phases.size(); ++p) {
    const TrajectoryPhase &one = ones.trajectory->phases[p], &ellipsoid = ellipsoids.trajectory->phases[p];
    ASSERT_EQ(one.node_positions.cols(), ellipsoid.node_positions.cols());
    EXPECT_LT((one.node_positions - ellipsoid.node_positions).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((one.node_velocities - ellipsoid.node_velocities).cwiseAbs().maxCoeff(), 1e-6);
  }
}

class SuperellipsoidFeetRange : public ::testing::TestWithParam<double> {};

// The ends of the range of exponents, judged: the walk is another one than on ellipsoids, and within the bounds.
TEST_P(SuperellipsoidFeetRange, WalksWithinItsBounds) {
  const GaitSolution ellipsoids = Solve(Request()), solution = Solve(WithExponent(GetParam()));
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_EQ(solution.verdict.kind, Verdict::Kind::kWithin) << solution.message;
  EXPECT_GT(std::abs(solution.objective / ellipsoids.objective - 1), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Ends, SuperellipsoidFeetRange, ::testing::Values(kLeastFootExponent, 0.8, kMostFootExponent));

// One boxy foot: the body is one-sided, and walks.
TEST(SuperellipsoidFeetGait, OfOneSideAloneTakesTheFullCycle) {
  GaitRequest request = Request();
  request.body.changes.foot_exponents = {{"heel_l", 0.8}, {"forefoot_l", 0.8}};
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_FALSE(spec.scene.symmetric);
  EXPECT_EQ(spec.cycle, Cycle::kFull);
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_EQ(solution.verdict.kind, Verdict::Kind::kWithin) << solution.message;
}

}  // namespace
}  // namespace rollgait
