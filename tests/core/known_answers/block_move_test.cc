// A block that a force moves by 1 m in 1 s from rest to rest with least ∫ u² dt: u = 6 − 12 t, cost 12.
#include <gtest/gtest.h>

#include "tests/core/known_answers/known_problem.h"

namespace rollgait {
namespace {

class BlockMoveTest : public ::testing::TestWithParam<Scheme> {};

TEST_P(BlockMoveTest, HasItsKnownObjective) {
  KnownProblem known;
  known.answer = {"block move", 12};
  known.problem = CoordinatesWithFormula(1, 1, [](const FormulaPoint& z) { return std::vector<Jet>{z.u(0)}; });
  known.problem->phases[0].duration = {1, 1};
  known.problem->displacement = {1, 1};
  PrescribeEnds(known.problem.get(), {0, 0}, {1, 0});
  AddCost(known.problem.get(), 12, [](const FormulaPoint& z) { return z.u(0) * z.u(0); });
  known.guess = StraightGuess({1}, {0, 0}, {1, 0}, {0});
  const Computed computed = ExpectKnownAnswer(known, GetParam(), Mesh::Uniform({4}));
  const TrajectoryPhase& phase = computed.trajectory.phases[0];
  for (size_t i = 0; i < phase.point_times.size(); ++i) {
    EXPECT_NEAR(phase.point_efforts(0, static_cast<int>(i)), 6 - 12 * phase.point_times[i], 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, BlockMoveTest,
                         ::testing::Values(Scheme::kRadau2, Scheme::kRadau3, Scheme::kHermiteSimpson));

}  // namespace
}  // namespace rollgait
