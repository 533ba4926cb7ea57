#include "core/gait/optimizing_gait_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/validation/gait_cycle.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

GaitRequest Planar(double slope_deg) {
  GaitRequest request;
  request.body.model = "planar";
  request.slope = slope_deg * kDegree;
  request.motion.speed = 1.3;
  return request;
}

GaitSolution Solve(const GaitRequest& request, const SolveControl& control = {}) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), control);
}

// Every slope and scheme converges from the built-in guess.
class ColdStart : public ::testing::TestWithParam<std::tuple<int, Scheme>> {};

TEST_P(ColdStart, ConvergesToTheRequestedKktError) {
  GaitRequest request = Planar(std::get<0>(GetParam()));
  request.discretization.scheme = std::get<1>(GetParam());
  request.discretization.single_support_intervals = 8;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  double last_objective = 0;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) { last_objective = info.objective; };
  const GaitSolution solution = Solve(request, control);
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_NEAR(last_objective / solution.objective, 1, 1e-12);
  EXPECT_LE(solution.kkt_error, 1e-6);
  EXPECT_LT(solution.constraint_violation, 1e-6);
  EXPECT_TRUE(solution.unmet_constraints.empty());
  ASSERT_TRUE(solution.trajectory && solution.accuracy);
  EXPECT_NEAR(solution.speed, 1.3, 1e-6);
  EXPECT_NEAR(solution.trajectory->displacement, solution.step_length, 1e-12);
  EXPECT_GT(solution.objective, 1);
}

INSTANTIATE_TEST_SUITE_P(SlopesAndSchemes, ColdStart,
                         ::testing::Combine(::testing::Values(-10, 0, 10),
                                            ::testing::Values(Scheme::kRadau2, Scheme::kRadau3,
                                                              Scheme::kHermiteSimpson)));

// The same search with Ipopt in place of our own solver.
TEST(SolverOfPrograms, IpoptIsWithinTheBoundsToo) {
  GaitRequest request = Planar(0);
  request.discretization.single_support_intervals = 8;
  request.nlp_solver = NlpSolver::kIpopt;
  const GaitSolution ipopt = Solve(request);
  ASSERT_EQ(ipopt.termination, Termination::kOptimal) << ipopt.message;
  EXPECT_EQ(ipopt.verdict.kind, Verdict::Kind::kWithin);
  EXPECT_GT(ipopt.meshes.size(), 1u);
}

// On one mesh: rough solutions of two solvers are refined in different places, and the objectives then differ by what
// a mesh leaves open (7e-5 with Debian 13's Ipopt).
TEST(SolverOfPrograms, IpoptAnswersTheSame) {
  GaitRequest request = Planar(0);
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const GaitSolution own = Solve(request);
  request.nlp_solver = NlpSolver::kIpopt;
  const GaitSolution ipopt = Solve(request);
  ASSERT_EQ(ipopt.termination, Termination::kOptimal) << ipopt.message;
  ASSERT_EQ(ipopt.meshes.back().intervals, own.meshes.back().intervals);
  EXPECT_NEAR(ipopt.objective / own.objective, 1, 1e-6);
  EXPECT_NE(ipopt.meshes.front().iterations, own.meshes.front().iterations);
}

// The drift trap: with contact on acceleration level alone the feet of the optimum sink by centimetres. Here gap and
// slip stay within the standard bounds between the nodes too.
TEST(StandardAccuracy, HoldsOnAllSlopes) {
  for (int slope : {-10, 0, 10}) {
    const GaitSolution solution = Solve(Planar(slope));
    ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
    EXPECT_TRUE(solution.within_requested_accuracy());
    EXPECT_LE(solution.accuracy->max_gap, 1e-4);
    EXPECT_LE(solution.accuracy->max_slip, 1e-3);
    EXPECT_GE(solution.accuracy->min_normal_force, 0);
    EXPECT_LT(solution.accuracy->periodicity_error, 1e-7);
    // Re-integration with the optimal torques: a hundredth of a radian is far above what these meshes leave (5e-4).
    EXPECT_LT(solution.accuracy->max_position_defect, 1e-2);
  }
}

// Without passive torques the net moments of the comparison with people, found from motion and forces, are the torques
// that were optimised: two ways to one curve. At the points of the mesh they are equal; between them they differ by its
// error.
TEST(Normative, NetMomentsAreTheTorques) {
  const GaitSpec spec = CheckRequest(Planar(0)).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, {});
  ASSERT_TRUE(solution.normative && solution.within_requested_accuracy());
  EXPECT_FALSE(solution.normative_left) << "it is the mirror image";
  EXPECT_NEAR(solution.normative->speed, solution.speed, 1e-9);
  EXPECT_NEAR(solution.normative->step_length, solution.step_length, 1e-9);
  const GaitCycle cycle = GaitCycle::Of(spec.scene, *solution.trajectory).value();
  int curves = 0;
  for (const DatasetComparison& set : solution.normative->datasets) {
    for (const CurveComparison& curve : set.curves) {
      if (curve.quantity != NormativeQuantity::kMoment) continue;
      ++curves;
      const int joint = LegJoint(spec.scene.model, curve.joint, BodySide::kRight);
      const auto& actuated = spec.scene.model.actuated();
      const auto effort = std::find(actuated.begin(), actuated.end(), joint) - actuated.begin();
      std::vector<double> torques;
      for (int i = 0; i < kNormativeSamples; ++i) {
        torques.push_back(-cycle.At(2.0 * i).efforts[effort] / spec.scene.model.total_mass());
      }
      const CurveDistance distance = MeasureDistance(curve.ours, torques, std::vector<double>(torques.size(), 1));
      EXPECT_GT(distance.correlation, 0.99) << curve.joint;
      EXPECT_LT(distance.rms, 0.02 * (curve.max - curve.min)) << curve.joint;
    }
  }
  EXPECT_EQ(curves, 3);
}

// What is solved is a gait and not a mesh: three schemes on a fine mesh, and one on a mesh twice as fine, agree on what
// it costs. With a bound of the swinging foot that no motion can keep, the cost grew by a tenth and more with every
// halving.
TEST(OptimumOfAMesh, IsThatOfEveryFinerMeshAndEveryScheme) {
  GaitRequest request = Planar(0);
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const auto objective = [&request](Scheme scheme, int intervals) {
    request.discretization.scheme = scheme;
    request.discretization.single_support_intervals = intervals;
    request.discretization.double_support_intervals = intervals / 2;
    const GaitSolution solution = Solve(request);
    EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
    return solution.objective;
  };
  const double fine = objective(Scheme::kRadau2, 128);
  EXPECT_NEAR(objective(Scheme::kRadau2, 64) / fine, 1, 5e-3);
  EXPECT_NEAR(objective(Scheme::kRadau3, 48) / fine, 1, 5e-3);
  EXPECT_NEAR(objective(Scheme::kHermiteSimpson, 48) / fine, 1, 5e-3);
  // Prices of rates need finer meshes, where the foot comes down.
  request.costs = {{cost::SquaredTorque{}, 1}, {cost::SquaredTorqueRate{}, 1e-4}};
  EXPECT_NEAR(objective(Scheme::kRadau2, 64) / objective(Scheme::kRadau2, 128), 1, 1e-2);
}

// Two steps without imposed symmetry are the one step and its mirror image.
TEST(Cycle, FullCycleFindsTheSymmetricGait) {
  // A mesh that is fine enough for the optimum to be a motion, which is symmetric; artefacts of coarse ones need not
  // be.
  GaitRequest request = Planar(0);
  request.discretization.single_support_intervals = 20;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const GaitSolution half = Solve(request);
  request.cycle = Cycle::kFull;
  const GaitSolution full = Solve(request);
  ASSERT_EQ(half.termination, Termination::kOptimal);
  ASSERT_EQ(full.termination, Termination::kOptimal);
  EXPECT_NEAR(full.objective / half.objective, 1, 1e-5);
  EXPECT_NEAR(full.step_length, half.step_length, 1e-4);
  EXPECT_EQ(full.trajectory->phases.size(), 4u);
}

TEST(Outcome, IsTheSameBitForBitEveryTime) {
  GaitRequest request = Planar(10);
  request.discretization.single_support_intervals = 4;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const GaitSolution first = Solve(request), second = Solve(request);
  EXPECT_EQ(first.objective, second.objective);
  EXPECT_TRUE(first.trajectory->phases[1].point_forces == second.trajectory->phases[1].point_forces);
}

TEST(Outcome, SlopeThatFrictionCannotCarryIsInfeasibleAndSaysWhy) {
  GaitRequest request = Planar(20);
  request.ground_contact.friction_coefficient = 0.3;
  const GaitSolution solution = Solve(request);
  EXPECT_EQ(solution.termination, Termination::kInfeasible);
  ASSERT_EQ(solution.unmet_constraints.size(), 1u);
  EXPECT_NE(solution.unmet_constraints[0].name.find("friction"), std::string::npos);
  EXPECT_NEAR(solution.unmet_constraints[0].violation, std::tan(20 * kDegree) - 0.3, 1e-12);
}

TEST(Outcome, StopFlagCancels) {
  StopFlag stop;
  int seen = 0;
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    EXPECT_EQ(info.index, seen++);
    if (seen == 3) stop.Request();
  };
  EXPECT_EQ(Solve(Planar(0), control).termination, Termination::kCancelled);
  EXPECT_EQ(seen, 3);
}

TEST(Outcome, IterationLimitNamesWhatIsNotMet) {
  GaitRequest request = Planar(0);
  request.solver_limits.max_iterations = 2;
  const GaitSolution solution = Solve(request);
  EXPECT_EQ(solution.termination, Termination::kIterationLimit);
  EXPECT_FALSE(solution.unmet_constraints.empty());
  EXPECT_FALSE(solution.within_requested_accuracy());
  for (size_t i = 1; i < solution.unmet_constraints.size(); ++i)
    EXPECT_FALSE(solution.unmet_constraints[i].name.empty());
}

}  // namespace
}  // namespace rollgait
