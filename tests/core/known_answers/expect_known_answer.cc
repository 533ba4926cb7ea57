#include "tests/core/known_answers/expect_known_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace rollgait {
namespace {

// Of two solvers with a tolerance of 1e-10.
constexpr double kSameObjective = 1e-9;
constexpr double kOrderTolerance = 0.5;

// From the same start: the solution before the last, or the guess.
void ExpectIpoptAgrees(const KnownProblem& known, const KnownRun& run, const KnownError& measured) {
  const KnownSolution& last = measured.solutions.back();
  const KnownSolution* before = run.halvings > 0 ? &measured.solutions[measured.solutions.size() - 2] : nullptr;
  const KnownSolution ipopt = SolveKnown(known, run.scheme, last.nlp->mesh(), before, KnownSolver::kIpopt);
  EXPECT_EQ(ipopt.result.termination, Termination::kOptimal) << ipopt.result.message;
  EXPECT_NEAR(ipopt.objective, last.objective, kSameObjective * std::abs(last.objective));
}

}  // namespace

KnownError ExpectKnownAnswer(const KnownProblem& known) {
  const KnownAnswer& answer = known.answer;
  const double unknown = answer.uncertainty / std::abs(answer.objective);
  KnownError reached;
  const KnownRun* reaching = nullptr;
  for (const KnownRun& run : known.runs) {
    SCOPED_TRACE(answer.problem + ", " + TraitsOf(run.scheme).name);
    KnownError measured = MeasureError(known, run);
    const KnownSolution& last = measured.solutions.back();
    EXPECT_TRUE(measured.converged) << last.result.message;
    EXPECT_LE(measured.error, measured.bar + unknown) << last.objective;
    if (run.order) {
      EXPECT_NEAR(measured.order, *run.order, kOrderTolerance) << last.objective;
    }
    if (!run.reaches) continue;
    EXPECT_LE(measured.error, answer.asked + unknown) << last.objective;
    EXPECT_LE(measured.bar, answer.asked) << "the bar is wider than what was asked";
    reached = std::move(measured);
    reaching = &run;
  }
  EXPECT_NE(reaching, nullptr) << answer.problem;
  if (reaching != nullptr) ExpectIpoptAgrees(known, *reaching, reached);
  return reached;
}

}  // namespace rollgait
