#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

TEST(FiveLinkBipedTest, HasItsKnownObjectiveAndNoBoundsThatItHasNot) {
  const KnownProblem known = FiveLinkBiped();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  EXPECT_GT(phase.impact_loss, 1);
  const auto expect_pushes = [](const Vector3& force) {
    EXPECT_GT(force.z(), 0) << force.transpose();
    EXPECT_LT(std::abs(force.x()), 2 * force.z()) << force.transpose();
  };
  expect_pushes(phase.impulses);
  for (int i = 0; i < phase.point_forces.cols(); ++i) expect_pushes(phase.point_forces.col(i));
  // The knees, and where they are straight.
  EXPECT_GT(phase.point_positions.row(4).maxCoeff(), -1e-5);
  EXPECT_LT(phase.point_positions.row(6).maxCoeff(), -1e-3);
  EXPECT_LT(phase.point_positions.row(4).minCoeff(), -0.1);
}

}  // namespace
}  // namespace rollgait
