#include <gtest/gtest.h>

#include <utility>

#include "tests/core/known_answers/expect_known_answer.h"

namespace rollgait {
namespace {

TEST(BlockMoveTest, HasItsKnownObjectiveAndEfforts) {
  const KnownProblem known = BlockMove();
  const KnownSolution solution = std::move(ExpectKnownAnswer(known).solutions.back());
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  for (size_t i = 0; i < phase.point_times.size(); ++i) {
    EXPECT_NEAR(phase.point_efforts(0, static_cast<int>(i)), 6 - 12 * phase.point_times[i], 1e-8);
  }
}

// With efforts that are constant within N equal intervals the least cost is 12/(1 − 1/N²): that of Σ u_k² h with
// Σ u_k h = 0 and Σ u_k (½ − t_k) h = 1, t_k the middles. Linear ones cost what free ones do.
TEST(BlockMoveTest, EffortsHaveTheDegreeThatThePhaseAllows) {
  const KnownProblem known = BlockMove();
  for (const KnownRun& run : known.runs) {
    for (const int degree : {0, 1, 2}) {
      known.problem->phases[0].effort_degree = degree;
      const KnownSolution solution = SolveKnown(known, run.scheme, Mesh::Uniform({4}));
      EXPECT_EQ(solution.result.termination, Termination::kOptimal) << solution.result.message;
      EXPECT_NEAR(solution.objective, degree == 0 ? 12 / (1 - 1.0 / 16) : 12, 1e-9)
          << TraitsOf(run.scheme).name << degree;
      const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
      for (int k = 0; degree == 0 && k < 4; ++k) {
        const int s = trajectory.points_per_interval;
        const auto efforts = trajectory.phases[0].point_efforts.row(0).segment(k * s, s);
        EXPECT_LT(efforts.maxCoeff() - efforts.minCoeff(), 1e-9) << TraitsOf(run.scheme).name << k;
      }
    }
  }
}

}  // namespace
}  // namespace rollgait
