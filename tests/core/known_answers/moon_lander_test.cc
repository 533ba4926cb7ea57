#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// The engine is off until 0.239259108626, then at its limit until 1.396808089107. A phase may end an interval before or
// after the instant of the switch, so that it is looked for at the points.
TEST(MoonLanderTest, HasItsKnownObjectiveSwitchAndDuration) {
  const KnownProblem known = MoonLander();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  EXPECT_NEAR(trajectory.duration, 1.396808089107, 1e-8);
  double switched = 0;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    for (int i = 0; i < phase.point_efforts.cols(); ++i) {
      const double thrust = phase.point_efforts(0, i), time = phase.point_times[static_cast<size_t>(i)];
      EXPECT_LT(std::min(thrust, 1.227 - thrust), 1e-6) << time;
      if (thrust < 0.6) switched = std::max(switched, time);
    }
  }
  EXPECT_NEAR(switched, 0.239259108626, 1e-7);
}

}  // namespace
}  // namespace rollgait
