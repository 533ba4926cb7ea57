// Walking in space on ground of little friction: within the cone as the judge sees it, and beyond any pyramid that has
// no edge there; edges are added where flat sides cost something, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/gait/added_constraints.h"
#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The force of each side that costs more than the least cost gets an edge, once, if it is inside the side.
TEST(AddFrictionEdges, WhereASideCostsMoreThanTheLeast) {
  const std::vector<FlatSide> sides = {{1, 0, {0, 9}, 0.011, 16 * kDegree},    // 3 · 5°
                                       {1, 0, {9, 18}, 0.009, 70 * kDegree},   // costs too little
                                       {1, 2, {63, 72}, 0.5, 341 * kDegree},   // 68 · 5°
                                       {1, 2, {18, 27}, 0.5, 91 * kDegree},    // next to an edge
                                       {1, 2, {63, 72}, 0.5, 359 * kDegree}};  // likewise
  AddedConstraints added;
  EXPECT_TRUE(AddFrictionEdges(sides, 0.01, &added));
  ASSERT_EQ(added.between.size(), 2u);
  EXPECT_TRUE(added.between[0].friction.empty());
  EXPECT_EQ(added.between[1].friction, (std::vector<FrictionEdge>{{0, 3}, {2, 68}}));
  EXPECT_FALSE(AddFrictionEdges(sides, 0.01, &added));
  EXPECT_EQ(added.between[1].friction.size(), 2u);
  EXPECT_TRUE(AddFrictionEdges(sides, 0.005, &added));
  EXPECT_EQ(added.between[1].friction, (std::vector<FrictionEdge>{{0, 3}, {0, 14}, {2, 68}}));
}

// A solution whose objective is 0 has sides that cost what the barrier leaves; they are not worth an edge.
TEST(AddFrictionEdges, NotForLessThanTheToleranceLeavesOpen) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.kkt_tolerance = 1e-5;
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_DOUBLE_EQ(LeastCostOfASide(spec, 0, 400), 4e-3);
  EXPECT_DOUBLE_EQ(LeastCostOfASide(spec, -3, 400), 4e-3);
  EXPECT_DOUBLE_EQ(LeastCostOfASide(spec, -40, 400), 4e-2);
}

class LowFriction : public ::testing::Test {
 protected:
  static GaitSpec Spec(double friction_coefficient, GaitRequest::AccuracyLevel level) {
    GaitRequest request;
    request.body.model = "human29";
    request.preset = Preset::kHuman;
    request.motion.speed = 1.3;
    request.starts = 1;
    request.ground_contact.friction_coefficient = friction_coefficient;
    request.discretization.single_support_intervals = 10;
    request.accuracy.level = level;
    return CheckRequest(request).value();
  }
  static GaitSolution Solve(const GaitSpec& spec) { return OptimizingGaitSolver().Solve(spec, {}); }
  static size_t Edges(const AddedConstraints& added) {
    size_t count = 0;
    for (const BoundedBetween& phase : added.between) count += phase.friction.size();
    return count;
  }
  // Of the forces at the points that carry weight the largest share of the cone that they take, along x or y alone or
  // in any direction, and the largest share of the pyramid with the usual edges alone.
  struct Shares {
    double along_axes = 0, cone = 0, usual_pyramid = 0;
  };
  static Shares SharesOf(const GaitSpec& spec, const Trajectory& trajectory) {
    Shares shares;
    const double least = 0.05 * spec.scene.model.total_mass() * spec.gravity.norm();
    for (const TrajectoryPhase& phase : trajectory.phases) {
      for (int point = 0; point < phase.point_forces.cols(); ++point) {
        for (int c = 0; c < static_cast<int>(phase.contacts.size()); ++c) {
          const Vector3 force = phase.point_forces.col(point).segment<3>(3 * c);
          if (force.z() < least) continue;
          const Vector3 share = force / (spec.friction_coefficient * force.z());
          shares.along_axes = std::max({shares.along_axes, std::abs(share.x()), std::abs(share.y())});
          shares.cone = std::max(shares.cone, share.head<2>().norm());
          for (double middle = 22.5; middle < 360; middle += 45) {
            const double outwards = share.x() * std::cos(middle * kDegree) + share.y() * std::sin(middle * kDegree);
            shares.usual_pyramid = std::max(shares.usual_pyramid, outwards / std::cos(22.5 * kDegree));
          }
        }
      }
    }
    return shares;
  }
};

TEST_F(LowFriction, TheConeIsUsedAndKept) {
  const GaitSpec spec = Spec(0.2, GaitRequest::AccuracyLevel::kStandard);
  const GaitSolution solution = Solve(spec);
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_TRUE(solution.within_requested_accuracy()) << solution.message;
  // As re-integrated, at every instant.
  EXPECT_LE(solution.accuracy->max_friction_ratio, 0.2 * (1 + spec.bounds[Criterion::kFriction]));
  const Shares shares = SharesOf(spec, *solution.trajectory);
  EXPECT_LE(shares.cone, 1 + 1e-6);
  EXPECT_GT(shares.cone, 0.999);
  EXPECT_GT(shares.along_axes, 0.9);  // the pyramid with four sides of μ/√2 ended at 0.707
  EXPECT_GT(Edges(solution.added), 0u);
  EXPECT_GT(shares.usual_pyramid, 1.003);
  // By its own multipliers no side costs much any more, but where its inner directions are taken.
  const auto problem = BuildProblem(spec);
  const CollocationNlp nlp(*problem, spec.scheme, MeshOf(*solution.trajectory), solution.added);
  ASSERT_EQ(solution.multipliers->rows.size(), nlp.constraints());
  const VectorX x = nlp.MakeStart(GuessFromTrajectory(*solution.trajectory));
  AddedConstraints more = solution.added;
  const auto sides = nlp.FlatSides(x.data(), nlp.objective_scale() * solution.multipliers->rows);
  const double least = LeastCostOfASide(spec, solution.objective, nlp.typical_objective());
  EXPECT_NEAR(least, 1e-3 * solution.objective, 1e-15);
  EXPECT_FALSE(AddFrictionEdges(sides, least, &more));
  EXPECT_TRUE(AddFrictionEdges(sides, 0.01 * least, &more));
}

// What the ground has is not asked for: the usual edges do.
TEST_F(LowFriction, EdgesAreNotAddedWhereFrictionDoesNotMatter) {
  const GaitSolution solution = Solve(Spec(0.8, GaitRequest::AccuracyLevel::kDraft));
  ASSERT_EQ(solution.termination, Termination::kOptimal);
  EXPECT_EQ(Edges(solution.added), 0u);
}

// A draft adds edges too, and a solve that starts from its solution has them from the start, with their multipliers.
TEST_F(LowFriction, AWarmStartHasTheEdgesOfItsSolution) {
  GaitSpec spec = Spec(0.2, GaitRequest::AccuracyLevel::kDraft);
  const GaitSolution cold = Solve(spec);
  ASSERT_EQ(cold.termination, Termination::kOptimal);
  ASSERT_GT(Edges(cold.added), 0u);
  spec.warm_start = WarmStart{*cold.trajectory, cold.multipliers, cold.added};
  const GaitSolution warm = Solve(spec);
  ASSERT_EQ(warm.termination, Termination::kOptimal);
  EXPECT_TRUE(warm.used_multipliers);
  EXPECT_EQ(warm.added, cold.added);
  EXPECT_EQ(warm.meshes.size(), 1u);
  EXPECT_NEAR(warm.objective, cold.objective, 1e-6 * cold.objective);
}

}  // namespace
}  // namespace rollgait
