#include <gtest/gtest.h>

#include <numbers>
#include <tuple>
#include <vector>

#include "core/contact/rolling_kinematics.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/validation/jumps.h"

namespace rollgait {
namespace {

GaitRequest Request(double slope_deg, GaitRequest::TouchDown touch_down) {
  GaitRequest request;
  request.body.model = "planar";
  request.slope = slope_deg * std::numbers::pi / 180;
  request.ground_contact.touch_down = touch_down;
  request.discretization.scheme = Scheme::kRadau3;
  request.discretization.single_support_intervals = 8;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  return request;
}

GaitSolution Solve(const GaitRequest& request) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), SolveControl());
}

class PlasticTouchDown : public ::testing::TestWithParam<int> {};

// A foot that comes down at rest is one that has no impulse, so that plastic touch-down can only be cheaper.
TEST_P(PlasticTouchDown, ConvergesAndCostsNoMoreThanSmooth) {
  const GaitSolution smooth = Solve(Request(GetParam(), GaitRequest::TouchDown::kSmooth));
  const GaitSolution plastic = Solve(Request(GetParam(), GaitRequest::TouchDown::kPlastic));
  ASSERT_EQ(smooth.termination, Termination::kOptimal);
  ASSERT_EQ(plastic.termination, Termination::kOptimal) << plastic.message;
  EXPECT_LT(plastic.objective, smooth.objective * (1 + 1e-6));
  EXPECT_EQ(smooth.accuracy->impact_loss, 0);
  for (const TrajectoryPhase& phase : smooth.trajectory->phases) EXPECT_FALSE(Jumps(phase));
  // What is left of the rows at a KKT error of 1e-6: of velocities at rest 1e-6 m/s and of 70 N s of impulses as many
  // parts.
  EXPECT_LT(plastic.accuracy->jump_velocity_error, 1e-4);
  EXPECT_LT(plastic.accuracy->jump_impulse_error, 1e-3);
  EXPECT_GT(plastic.accuracy->min_jump_impulse, -1e-4);
  EXPECT_GT(plastic.accuracy->impact_loss, 0);
  EXPECT_LT(plastic.accuracy->periodicity_error, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Slopes, PlasticTouchDown, ::testing::Values(-10, 0, 10));

// Two steps: one jump starts the cycle, one is between its phases.
TEST(PlasticTouchDownJudge, SeesWhatIsWrongAtItsSize) {
  GaitRequest request = Request(-10, GaitRequest::TouchDown::kPlastic);
  request.cycle = Cycle::kFull;
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  ValidationOptions options;
  options.gravity = spec.gravity;
  const AccuracyReport good = Validate(spec.scene, *solution.trajectory, options);
  double loss = 0;
  for (const TrajectoryPhase& phase : solution.trajectory->phases) loss += phase.impact_loss;
  EXPECT_NEAR(good.impact_loss, loss, 1e-6 * loss);
  EXPECT_GT(loss, 10);
  EXPECT_LT(good.max_position_defect, 0.1);  // of this coarse mesh; a jump that was integrated over would be 1 and more

  Trajectory wrong = *solution.trajectory;
  wrong.phases[2].impulses(2) += 3;
  AccuracyReport report = Validate(spec.scene, wrong, options);
  EXPECT_NEAR(report.jump_impulse_error, 3, 1e-3);
  EXPECT_EQ(report.jump_velocity_error, good.jump_velocity_error);
  EXPECT_GT(std::abs(report.momentum_balance_error - good.momentum_balance_error), 1);

  wrong = *solution.trajectory;
  wrong.phases[2].impact_loss += 5;
  report = Validate(spec.scene, wrong, options);
  EXPECT_NEAR(std::abs(report.energy_balance_error - good.energy_balance_error), 5,
              2 * good.energy_balance_error + 1e-9);

  for (const int phase : {0, 2}) {
    wrong = *solution.trajectory;
    wrong.phases[phase].node_velocities(4, 0) += 0.2;
    EXPECT_NEAR(Validate(spec.scene, wrong, options).jump_velocity_error, 0.2, 1e-3);
  }
}

// Where a surface touches the ground along its first axis, -1 (heel) to 1 (toe), by the judge's kinematics.
double ContactPoint(const Scene& scene, const TrajectoryPhase& phase, const char* contact) {
  const ContactSurface& surface = scene.contacts[scene.FindContact(contact)];
  BodyDynamics::State state;
  BodyDynamics(scene.model).ComputeState(phase.node_positions.col(0), phase.node_velocities.col(0), &state);
  const Vector3 p_L =
      state[surface.joint].R_WL.transpose() * (ComputeRollingContact(surface, state).p_WP - state[surface.joint].p_WL);
  return (surface.R_LE.transpose() * (p_L - surface.p_LE)).x() / surface.surface.ellipsoid()->semi_axes().x();
}

// Equation (4.3) of the paper: heel strike and toe-off at prescribed points, on all its slopes, with either touch-down.
class ContactPoints : public ::testing::TestWithParam<std::tuple<int, GaitRequest::TouchDown>> {};

TEST_P(ContactPoints, AreWhereTheRequestPutsThem) {
  GaitRequest request = Request(std::get<0>(GetParam()), std::get<1>(GetParam()));
  request.ground_contact.touch_down_point = GaitRequest::Range{-0.6, -0.6};
  request.ground_contact.lift_off_point = GaitRequest::Range{0.5, 0.7};
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  const std::vector<TrajectoryPhase>& phases = solution.trajectory->phases;
  EXPECT_NEAR(ContactPoint(spec.scene, phases[0], "left_foot"), -0.6, 1e-6);
  const double lift_off = ContactPoint(spec.scene, phases[1], "right_foot");
  EXPECT_GE(lift_off, 0.5 - 1e-6);
  EXPECT_LE(lift_off, 0.7 + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Slopes, ContactPoints,
                         ::testing::Combine(::testing::Values(-10, 0, 10),
                                            ::testing::Values(GaitRequest::TouchDown::kSmooth,
                                                              GaitRequest::TouchDown::kPlastic)));

}  // namespace
}  // namespace rollgait
