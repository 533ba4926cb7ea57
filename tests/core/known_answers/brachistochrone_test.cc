#include <gtest/gtest.h>

#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

TEST(BrachistochroneTest, HasItsKnownObjectiveAndKeepsItsEnergy) {
  const KnownProblem known = Brachistochrone();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  for (int k = 0; k < phase.node_velocities.cols(); ++k) {
    const double y = phase.node_velocities(1, k), speed = phase.node_velocities(2, k);
    EXPECT_NEAR(speed * speed / 2, 9.80665 * (10 - y), 1e-6) << k;  // ½ s² = g (10 − y)
  }
}

}  // namespace
}  // namespace rollgait
