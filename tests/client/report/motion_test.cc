#include "client/report/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

TEST(LagrangeCoefficientsTest, InterpolatesQuadraticExactly) {
  const std::vector<double> nodes = {0.2, 0.7, 1.0};
  const auto rows = LagrangeCoefficients(nodes);
  // 3 − 2θ + 5θ² from its values at the nodes.
  std::vector<double> coefficients(3, 0.0);
  for (int i = 0; i < 3; ++i) {
    const double value = 3 - 2 * nodes[i] + 5 * nodes[i] * nodes[i];
    for (int j = 0; j < 3; ++j) coefficients[j] += value * rows[i][j];
  }
  EXPECT_NEAR(coefficients[0], 3, 1e-12);
  EXPECT_NEAR(coefficients[1], -2, 1e-12);
  EXPECT_NEAR(coefficients[2], 5, 1e-12);
}

TEST(MotionTest, FollowsTheFunctionsItWasSampledFrom) {
  const v1::Model model = SampleModel();
  const Motion motion(SampleTrajectory(model), model);
  for (const double t : {0.0, 0.013, 0.0999, 0.2, 0.37, 0.5401, kSampleSpan_s}) {
    const Instant instant = motion.At(t);
    for (int j = 0; j < model.joints_size(); ++j) {
      // A linear acceleration over intervals of 18 ms: the position error is h⁴/24 · q⁗ ~ 1e-5 rad.
      EXPECT_NEAR(instant.position[j], SamplePosition(model, j, t), 5e-5) << model.joints(j).name() << " at " << t;
      const double rate = (SamplePosition(model, j, t + 1e-5) - SamplePosition(model, j, t - 1e-5)) / 2e-5;
      EXPECT_NEAR(instant.velocity[j], rate, 1e-2) << model.joints(j).name() << " at " << t;
    }
  }
}

TEST(MotionTest, AJumpAtAPhaseBorderHasTwoSides) {
  const v1::Model model = SampleModel();
  const Motion motion(SampleTrajectory(model), model);
  const double border = motion.phases()[1].start_s;
  EXPECT_THAT(motion.At(border).active, testing::ElementsAre(true, false));
  EXPECT_THAT(motion.At(border, true).active, testing::ElementsAre(true, true));
}

TEST(MotionTest, ColumnsFollowNamesNotOrder) {
  const v1::Model model = SampleModel();
  v1::Trajectory trajectory = SampleTrajectory(model);
  const Motion straight(trajectory, model);
  // Swap the first two columns of everything that has a column a joint, and their names.
  trajectory.mutable_joint_names()->SwapElements(0, 1);
  const int nq = model.joints_size();
  for (v1::TrajectoryPhase& phase : *trajectory.mutable_phases()) {
    for (v1::Matrix* const matrix :
         {phase.mutable_node_positions(), phase.mutable_node_velocities(), phase.mutable_point_accelerations()}) {
      for (int row = 0; row < matrix->rows(); ++row) matrix->mutable_values()->SwapElements(row * nq, row * nq + 1);
    }
  }
  const Motion swapped(trajectory, model);
  EXPECT_EQ(straight.At(0.3).position, swapped.At(0.3).position);
}

TEST(MotionTest, RefusesATrajectoryThatDoesNotFit) {
  const v1::Model model = SampleModel();
  const auto refusal = [&model](const v1::Trajectory& trajectory) -> std::string {
    try {
      const Motion motion(trajectory, model);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "accepted";
  };
  v1::Trajectory trajectory = SampleTrajectory(model);
  trajectory.mutable_phases(1)->mutable_point_forces()->add_values(1);
  EXPECT_THAT(refusal(trajectory), testing::HasSubstr("phases[1].point_forces"));
  trajectory = SampleTrajectory(model);
  trajectory.set_joint_names(4, "elbow");
  EXPECT_THAT(refusal(trajectory), testing::HasSubstr("elbow"));
  trajectory = SampleTrajectory(model);
  trajectory.mutable_phases(0)->set_node_times_s(1, 0);
  EXPECT_THAT(refusal(trajectory), testing::HasSubstr("phases[0].node_times_s must increase"));
  trajectory = SampleTrajectory(model);
  trajectory.clear_phases();
  EXPECT_THAT(refusal(trajectory), testing::HasSubstr("phases is empty"));
}

}  // namespace
}  // namespace rollgait::client
