#include <gtest/gtest.h>

#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// What the force does on the cart is the energy that the pole has at the top: m g 2 l.
TEST(CartPoleTest, HasItsKnownObjectiveAndEnergy) {
  const KnownProblem known = CartPole();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  const int s = trajectory.points_per_interval;
  double work = 0;
  for (size_t k = 0; k + 1 < phase.node_times.size(); ++k) {
    const double h = phase.node_times[k + 1] - phase.node_times[k];
    const VectorX weights = TableauOf(Scheme::kRadau3).b;
    ASSERT_EQ(weights.size(), s);
    for (int i = 0; i < s; ++i) {
      const int point = static_cast<int>(k) * s + i;
      work += h * weights(i) * phase.point_efforts(0, point) * phase.point_velocities(0, point);
    }
  }
  EXPECT_NEAR(work, 0.3 * 9.81 * 2 * 0.5, 1e-6);
}

}  // namespace
}  // namespace rollgait
