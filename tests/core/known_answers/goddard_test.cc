#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

// The arcs end at 0.0235096840415 and 0.0726707434415, the flight at 0.1988562621. On the singular arc
// m g = D (1 + v/c) with c = 1/2.
TEST(GoddardTest, HasItsKnownObjectiveAndArcs) {
  const KnownProblem known = Goddard();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  EXPECT_NEAR(0.1 * trajectory.phases[0].duration, 0.0235096840415, 1e-6);
  EXPECT_NEAR(0.1 * trajectory.phases[2].start, 0.0726707434415, 1e-5);
  EXPECT_NEAR(0.1 * trajectory.duration, 0.1988562621, 1e-5);
  EXPECT_EQ(trajectory.phases[0].point_efforts.minCoeff(), 3.5);
  EXPECT_EQ(trajectory.phases[2].point_efforts.cwiseAbs().maxCoeff(), 0);
  const TrajectoryPhase& arc = trajectory.phases[1];
  for (int k = 0; k < arc.node_positions.cols(); ++k) {
    const double h = 1 + 0.01 * arc.node_positions(0, k), v = 0.1 * arc.node_velocities(0, k);
    const double drag = 310 * v * v * std::exp(-500 * (h - 1)), weight = arc.node_velocities(1, k) / (h * h);
    EXPECT_NEAR(drag * (1 + 2 * v) / weight, 1, 1e-3) << k;
  }
}

// Thrust that is free at every point of the singular arc follows the errors of the discretisation: the rocket seems to
// climb higher than it can, by far more than the scheme's own error.
TEST(GoddardTest, FreeThrustOnTheSingularArcGainsHeightThatDoesNotExist) {
  const KnownProblem known = Goddard();
  const auto excess = [&known](std::optional<int> degree) {
    known.problem->phases[1].effort_degree = degree;
    const KnownError measured = MeasureError(known, {Scheme::kRadau2, Mesh::Uniform({4, 4, 4}), 2});
    EXPECT_TRUE(measured.converged);
    return (known.answer.objective - measured.solutions.back().objective) / std::abs(known.answer.objective);
  };
  const double constant = excess(0), free = excess(std::nullopt);
  EXPECT_GT(free, 1e-3);
  EXPECT_GT(free, 5 * std::abs(constant));
}

}  // namespace
}  // namespace rollgait
