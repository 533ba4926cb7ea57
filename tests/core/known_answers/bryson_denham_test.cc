#include <gtest/gtest.h>

#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// The arc on the bound begins at 3ℓ and ends at 1 − 3ℓ. Where exactly matters little: its objective is flat there to
// third order.
TEST(BrysonDenhamTest, HasItsKnownObjectiveAndArc) {
  const KnownProblem known = BrysonDenham();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  EXPECT_NEAR(trajectory.phases[0].duration, 1.0 / 3, 1e-4);
  EXPECT_NEAR(trajectory.phases[2].duration, 1.0 / 3, 1e-4);
  const TrajectoryPhase& arc = trajectory.phases[1];
  EXPECT_LT((arc.node_positions.array() - 1.0 / 9).abs().maxCoeff(), 1e-9);
  EXPECT_LT(arc.point_efforts.cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace rollgait
