// A bead that slides without friction from (0, 10) to (10, 5) m in the least time: ẋ = s sin θ, ẏ = −s cos θ,
// ṡ = g cos θ. All states have a first derivative only, and the formula bends in velocities and controls.
#include <gtest/gtest.h>

#include "core/ocp/costs/point_costs.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {
namespace {

TEST(BrachistochroneTest, HasItsKnownObjective) {
  KnownProblem known;
  known.answer = {"brachistochrone", 1.80160312245308};
  known.problem = CoordinatesWithFormula(3, 1, [](const FormulaPoint& z) {
    return std::vector<Jet>{z.v(2) * sin(z.u(0)), -z.v(2) * cos(z.u(0)), 9.80665 * cos(z.u(0))};
  });
  known.problem->phases[0].duration = {0.1, 10};
  PrescribeEnds(known.problem.get(), {0, 0, 0, 0, 10, 0}, {kFree, kFree, kFree, 10, 5, kFree});
  CostDescription time;
  time.term = std::make_unique<TimeCost>();
  known.problem->costs.push_back(std::move(time));
  known.guess = StraightGuess({2}, {0, 0, 0, 0, 10, 0}, {10, 15, 10, 10, 5, 9}, {1});
  const Computed computed = ExpectKnownAnswer(known, Scheme::kRadau3, Mesh::Uniform({20}));
  // Energy is kept, ½ s² = g (10 − y), to what 20 intervals of order 5 leave.
  const TrajectoryPhase& phase = computed.trajectory.phases[0];
  for (int k = 0; k < phase.node_velocities.cols(); ++k) {
    const double y = phase.node_velocities(1, k), speed = phase.node_velocities(2, k);
    EXPECT_NEAR(speed * speed / 2, 9.80665 * (10 - y), 1e-6) << k;
  }
}

}  // namespace
}  // namespace rollgait
