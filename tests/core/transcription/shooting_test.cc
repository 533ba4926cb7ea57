// Direct multiple shooting: every interval of a solved gait is one step of Kutta's 3/8 rule, taken here with the
// forward dynamics by which trajectories are judged.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/contact/constrained_dynamics.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

class ShootingTest : public ::testing::TestWithParam<Scheme> {
 protected:
  static GaitRequest Request() {
    GaitRequest request;
    request.body.model = "planar";
    request.motion.speed = 1.3;
    request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    request.discretization = {GetParam(), 16, 8};
    request.costs = {{cost::SquaredTorque{}, 1.0}};
    return request;
  }
};

TEST_P(ShootingTest, EveryIntervalIsOneStepOfTheMethod) {
  const GaitSpec spec = CheckRequest(Request()).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  const Trajectory& trajectory = *solution.trajectory;
  EXPECT_EQ(trajectory.scheme, Scheme::kHermiteSimpson);
  const BodyDynamics dynamics(spec.scene.model);
  const std::vector<int>& actuated = spec.scene.model.actuated();
  int steps = 0;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    std::vector<ContactSurface> surfaces;
    for (const int c : phase.contacts) surfaces.push_back(spec.scene.contacts[c]);
    ConstrainedDynamics forward(dynamics, surfaces);
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k, ++steps) {
      const double h = phase.node_times[k + 1] - phase.node_times[k];
      const auto acceleration = [&](double theta, const VectorX& q, const VectorX& v) -> VectorX {
        const VectorX efforts = SampleEfforts(trajectory, p, k, theta);
        VectorX tau = VectorX::Zero(q.size());
        for (size_t a = 0; a < actuated.size(); ++a) tau(actuated[a]) = efforts(static_cast<int>(a));
        return forward.Evaluate(q, v, tau, spec.gravity).acceleration;
      };
      const VectorX q = phase.node_positions.col(k), v = phase.node_velocities.col(k);
      const VectorX a1 = acceleration(0, q, v);
      const VectorX v2 = v + h / 3 * a1, a2 = acceleration(1.0 / 3, q + h / 3 * v, v2);
      const VectorX v3 = v + h * (a2 - a1 / 3), a3 = acceleration(2.0 / 3, q + h * (v2 - v / 3), v3);
      const VectorX v4 = v + h * (a1 - a2 + a3), a4 = acceleration(1, q + h * (v - v2 + v3), v4);
      const VectorX q_end = q + h / 8 * (v + 3 * v2 + 3 * v3 + v4), v_end = v + h / 8 * (a1 + 3 * a2 + 3 * a3 + a4);
      // Rows of motion are met to 1e-6 of body weight, and joints have inertias down to 0.01 kg m².
      EXPECT_LT((q_end - phase.node_positions.col(k + 1)).cwiseAbs().maxCoeff(), 1e-6) << p << " " << k;
      EXPECT_LT((v_end - phase.node_velocities.col(k + 1)).cwiseAbs().maxCoeff(), 1e-4) << p << " " << k;
      EXPECT_LT((a1 - phase.point_accelerations.col(3 * k)).cwiseAbs().maxCoeff(), 1e-2) << p << " " << k;
    }
  }
  EXPECT_EQ(steps, 24);
}

TEST_P(ShootingTest, EffortsHaveTheirDegreeInEveryInterval) {
  const GaitSolution solution = OptimizingGaitSolver().Solve(CheckRequest(Request()).value(), SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  double steepest = 0, jump = 0;
  for (const TrajectoryPhase& phase : solution.trajectory->phases) {
    for (int column = 0; column < phase.point_efforts.cols(); column += 3) {
      if (column > 0) {
        jump = std::max(jump,
                        (phase.point_efforts.col(column) - phase.point_efforts.col(column - 1)).cwiseAbs().maxCoeff());
      }
      const VectorX first = phase.point_efforts.col(column), middle = phase.point_efforts.col(column + 1),
                    last = phase.point_efforts.col(column + 2);
      EXPECT_LT((first - 2 * middle + last).cwiseAbs().maxCoeff(), 1e-3) << column;  // N m
      steepest = std::max(steepest, (last - first).cwiseAbs().maxCoeff());
    }
  }
  if (GetParam() == Scheme::kShootingConstant) {
    EXPECT_LT(steepest, 1e-3);
    EXPECT_GT(jump, 1);
  } else {
    EXPECT_GT(steepest, 1);
    EXPECT_LT(jump, 1e-3);  // within phases
  }
}

INSTANTIATE_TEST_SUITE_P(Controls, ShootingTest, ::testing::Values(Scheme::kShootingConstant, Scheme::kShootingLinear));

// Efforts that are constant in every interval have no rate there: what a cost of rates would forbid is every jump.
TEST(Shooting, RatesOfConstantEffortsAreRefused) {
  GaitRequest request;
  request.body.model = "planar";
  request.costs = {{cost::SquaredTorque{}, 1.0}, {cost::SquaredTorqueRate{}, 1e-4}};
  for (const SchemeTraits& traits : Schemes()) {
    request.discretization.scheme = traits.scheme;
    const auto checked = CheckRequest(request);
    EXPECT_EQ(checked.ok(), traits.scheme != Scheme::kShootingConstant) << traits.word;
    if (checked.ok()) continue;
    ASSERT_EQ(checked.violations().size(), 1u);
    EXPECT_EQ(checked.violations()[0].field, "discretization.scheme");
    for (const char* said : {"the cost has squared_torque_rate, which", "take shooting-linear"}) {
      EXPECT_NE(checked.violations()[0].message.find(said), std::string::npos) << checked.violations()[0].message;
    }
  }
  // A weight of 0 takes a term out.
  request.discretization.scheme = Scheme::kShootingConstant;
  request.costs[1].weight = 0;
  EXPECT_TRUE(CheckRequest(request).ok());
}

}  // namespace
}  // namespace rollgait
