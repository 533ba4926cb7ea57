// What Trajectory says of its numbers, on solved gaits of every scheme.
#include <gtest/gtest.h>

#include "core/contact/rolling_kinematics.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/math/collocation.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/sampling.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

class ExchangeTest : public ::testing::TestWithParam<Scheme> {
 protected:
  static GaitSpec Spec(Cycle cycle) {
    GaitRequest request;
    request.body.model = "planar";
    request.motion.speed = 1.3;
    request.cycle = cycle;
    request.starts = 1;
    request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    request.discretization = {GetParam(), 10, 5};
    return CheckRequest(request).value();
  }
};

TEST_P(ExchangeTest, PointsLieOnThePolynomials) {
  for (const Cycle cycle : {Cycle::kHalf, Cycle::kFull}) {
    const GaitSolution solution = OptimizingGaitSolver().Solve(Spec(cycle), SolveControl());
    ASSERT_EQ(solution.termination, Termination::kOptimal);
    const Trajectory& trajectory = *solution.trajectory;
    const int s = trajectory.points_per_interval;
    for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
      const TrajectoryPhase& phase = trajectory.phases[p];
      const int n = static_cast<int>(phase.node_positions.rows());
      for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k) {
        const double h = phase.node_times[k + 1] - phase.node_times[k];
        const VectorX c = Eigen::Map<const VectorX>(trajectory.point_fractions.data(), s);
        for (int i = 0; i < s; ++i) {
          // The integrals of the Lagrange polynomials, a second derivation of those in Sample.
          const MatrixX a = phase.point_accelerations.middleCols(k * s, s);
          const VectorX velocity = phase.node_velocities.col(k) + h * a * LagrangeIntegrals(c, c(i));
          const VectorX position = phase.node_positions.col(k) + h * c(i) * phase.node_velocities.col(k) +
                                   h * h * a * LagrangeSecondIntegrals(c, c(i));
          for (int j = 0; j < n; ++j) {
            EXPECT_NEAR(phase.point_positions(j, k * s + i), position(j), 1e-12 * (1 + std::abs(position(j))));
            EXPECT_NEAR(phase.point_velocities(j, k * s + i), velocity(j), 1e-12 * (1 + std::abs(velocity(j))));
          }
        }
        // The last point is the next node: what the elimination of the accelerations promises. Accelerations are
        // differences of positions over h², so that the rounding of positions remains.
        const auto at_end = k * s + s - 1;
        EXPECT_LT((phase.point_positions.col(at_end) - phase.node_positions.col(k + 1)).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((phase.point_velocities.col(at_end) - phase.node_velocities.col(k + 1)).cwiseAbs().maxCoeff(), 1e-11);
      }
    }
  }
}

class CollocationExchangeTest : public ExchangeTest {};

// At the stage positions that Trajectory names, the equations of motion hold to the tolerance of the solve; at q(t)
// they do not, where the two differ.
TEST_P(CollocationExchangeTest, EquationsOfMotionHoldAtStagePositions) {
  const GaitSpec spec = Spec(Cycle::kHalf);
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal);
  const Tableau tableau = TableauOf(GetParam());
  const int s = tableau.points();
  const BodyDynamics dynamics(spec.scene.model);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  VectorX residual;
  const auto measure = [&](const TrajectoryPhase& phase, int column, const VectorX& q) {
    dynamics.ComputeState(q, phase.point_velocities.col(column), &state);
    dynamics.InverseDynamics(state, phase.point_accelerations.col(column), spec.gravity, &workspace, &residual);
    for (size_t a = 0; a < spec.scene.model.actuated().size(); ++a) {
      residual(spec.scene.model.actuated()[a]) -= phase.point_efforts(static_cast<int>(a), column);
    }
    for (size_t c = 0; c < phase.contacts.size(); ++c) {
      const ContactSurface& contact = spec.scene.contacts[phase.contacts[c]];
      MatrixX jacobian = MatrixX::Zero(6, q.size());
      dynamics.AddTwistJacobian(state, contact.joint, ComputeRollingContact(contact, state).p_WP, 1, &jacobian);
      residual -=
          jacobian.bottomRows<3>().transpose() * phase.point_forces.block<3, 1>(3 * static_cast<int>(c), column);
    }
    return residual.cwiseAbs().maxCoeff();  // N m or N
  };
  double largest = 0, of_polynomial = 0;
  for (const TrajectoryPhase& phase : solution.trajectory->phases) {
    for (int column = 0; column < phase.point_accelerations.cols(); ++column) {
      const int k = column / s, i = column % s;
      const double h = phase.node_times[k + 1] - phase.node_times[k];
      const VectorX weights = (tableau.A * tableau.A).row(i);
      const VectorX q = phase.node_positions.col(k) + h * tableau.c(i) * phase.node_velocities.col(k) +
                        h * h * phase.point_accelerations.middleCols(k * s, s) * weights;
      largest = std::max(largest, measure(phase, column, q));
      of_polynomial = std::max(of_polynomial, measure(phase, column, phase.point_positions.col(column)));
      if (i == s - 1 || tableau.c(i) == 0) {
        EXPECT_LT((q - phase.point_positions.col(column)).cwiseAbs().maxCoeff(), 1e-12);
      }
    }
  }
  EXPECT_LT(largest, 1e-3);  // 1e-6 of forces near body weight
  EXPECT_GT(of_polynomial, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ExchangeTest, ::testing::ValuesIn(EveryScheme()));
INSTANTIATE_TEST_SUITE_P(Schemes, CollocationExchangeTest, ::testing::ValuesIn(EveryCollocation()));

}  // namespace
}  // namespace rollgait
