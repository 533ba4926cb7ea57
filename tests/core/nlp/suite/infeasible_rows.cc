// Programs without a feasible point. The value is the sum of the violations of rows at their minimiser of
// infeasibility, which follows from the formulas by hand.
#include <cmath>

#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {
namespace {

Answer Infeasible(double least_violation) {
  Answer answer{{least_violation}};
  // Restoration phases end where the sum of violations is stationary to 1e-8, with a barrier of about that size for
  // each elastic variable; the sum is a kinked function, so its error is of first order in both.
  answer.tolerance = 1e-5;
  answer.why = "restoration minimises the sum with a barrier";
  answer.ours = answer.ipopt = Termination::kInfeasible;
  answer.restores = Restores::kYes;
  return answer;
}

}  // namespace

std::vector<SuiteRow> InfeasibleRows() {
  return {
      Row("square is -1", {2}, {kFree}, {{-1, -1}}, Written([](const auto* x, auto* y) {
            y[0] = x[0];
            y[1] = x[0] * x[0];
          }),
          Infeasible(1)),
      // x + y ≥ 3 and x + y ≤ 1.
      Row("parallel lines", {5, -3}, Each(2, {-10, 10}), {{3, kNone}, {-kNone, 1}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0]) + Square(x[1]);
            y[1] = y[2] = x[0] + x[1];
          }),
          Infeasible(2)),
      // With x ≤ 5 the squares add up to at most 100.
      Row("HS71, sum 150", {1, 5, 5, 1}, Each(4, {1, 5}), {{25, kNone}, {150, 150}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
            y[1] = x[0] * x[1] * x[2] * x[3];
            y[2] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
          }),
          Infeasible(50)),
      // The next three: Byrd, Curtis and Nocedal, SIAM J. Optim. 20, 2010, "isolated", "nactive", "unique".
      Row("isolated", {3, 2}, Each(2, kFree), Each(4, {1, kNone}), Written([](const auto* x, auto* y) {
            y[0] = x[0] + x[1];
            y[1] = -x[0] * x[0] + x[1];
            y[2] = -x[0] * x[0] - x[1];
            y[3] = x[0] - x[1] * x[1];
            y[4] = -x[0] - x[1] * x[1];
          }),
          Infeasible(4)),
      Row("nactive", {-20, 10}, Each(2, kFree), {{0.5, kNone}, kPositive, kPositive},
          Written([](const auto* x, auto* y) {
            y[0] = x[0];
            y[1] = -0.5 * (x[0] + x[1] * x[1]);
            y[2] = x[0] - x[1] * x[1];
            y[3] = x[1] * x[1] - x[0];
          }),
          Infeasible(0.5)),
      Row("unique", {3, 2}, Each(2, kFree), {{1, kNone}, kPositive}, Written([](const auto* x, auto* y) {
            y[0] = x[0] + x[1];
            y[1] = x[1] - x[0] * x[0];
            y[2] = 0.3 * (1 - exp(x[1]));
          }),
          Infeasible(0.3 * (std::exp(1.0) - 1))),
      // Circles of radius 1 whose centres are 4 apart: between them, where each violation is 3 or less; the sum of
      // (x − 2)² + y² − 1 and (x + 2)² + y² − 1 is least at the origin.
      Row("distant circles", {0.5, 1}, Each(2, kFree), Each(2, {1, 1}), Written([](const auto* x, auto* y) {
            y[0] = x[0] + x[1];
            y[1] = Square(x[0] - 2) + x[1] * x[1];
            y[2] = Square(x[0] + 2) + x[1] * x[1];
          }),
          Infeasible(6)),
  };
}

}  // namespace rollgait::suite
