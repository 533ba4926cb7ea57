#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// In the middle x is e⁻²⁵ or less: both layers end within some seconds.
TEST(HypersensitiveTest, HasItsKnownObjectiveAndLayers) {
  const KnownProblem known = Hypersensitive();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  EXPECT_EQ(phase.node_velocities(0, 0), 1.5);
  for (size_t k = 0; k < phase.node_times.size(); ++k) {
    const double from_end = std::min(phase.node_times[k], 50 - phase.node_times[k]);
    EXPECT_LE(std::abs(phase.node_velocities(0, static_cast<int>(k))), 1.5 * std::exp(-0.9 * from_end) + 1e-7);
  }
}

}  // namespace
}  // namespace rollgait
