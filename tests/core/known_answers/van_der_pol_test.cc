#include <gtest/gtest.h>

#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// The control starts at its lower bound, and is at its upper one around 1.25 s.
TEST(VanDerPolTest, HasItsKnownObjectiveAndArcs) {
  const KnownProblem known = VanDerPol();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  for (size_t i = 0; i < phase.point_times.size(); ++i) {
    const double time = phase.point_times[i], control = phase.point_efforts(0, static_cast<int>(i));
    const bool on_lower = time<0.04, on_upper = time> 1.1 && time<1.4, between = time> 0.06 && time < 1;
    if (on_lower) {
      EXPECT_NEAR(control, -0.3, 1e-5) << time;
    }
    if (on_upper) {
      EXPECT_NEAR(control, 1, 1e-5) << time;
    }
    if (between || time > 1.5) {
      EXPECT_GT(control, -0.3 + 1e-3) << time;
      EXPECT_LT(control, 1 - 1e-3) << time;
    }
  }
}

}  // namespace
}  // namespace rollgait
