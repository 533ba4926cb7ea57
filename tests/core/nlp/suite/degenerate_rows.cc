// Programs at whose solutions or on the way to them gradients of constraints depend on each other. Their optimal values
// follow from their formulas by hand.
#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {

std::vector<SuiteRow> DegenerateRows() {
  const Answer local{{1.5},
                     1e-6,
                     "a local minimum of the sum of violations",
                     Termination::kInfeasible,
                     Termination::kInfeasible,
                     Restores::kYes};
  return {
      // Hock and Schittkowski: no multipliers at (1, 0), where the gradient of the row is that of a bound.
      Row("HS13", {-2, -2}, Each(2, kPositive), {kPositive}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 2) + x[1] * x[1];
            y[1] = Power(1 - x[0], 3) - x[1];
          }),
          {{1}, 2e-3, "without multipliers the error of x falls with the cube root of the tolerance"}),
      // Five lines and bounds meet in one vertex of the plane, (1, 1).
      Row("vertex of five", {0.1, 0.2}, {{-kNone, 1}, {-kNone, 1}}, {{-kNone, 2}, {-kNone, 3}, {-kNone, 3}},
          Written([](const auto* x, auto* y) {
            y[0] = -x[0] - x[1];
            y[1] = x[0] + x[1];
            y[2] = 2 * x[0] + x[1];
            y[3] = x[0] + 2 * x[1];
          }),
          {{-2}}),
      // Beale, 1955: the simplex method cycles here.
      Row("Beale's cycle", {0, 0, 0, 0}, Each(4, kPositive), {{-kNone, 0}, {-kNone, 0}, {-kNone, 1}},
          Written([](const auto* x, auto* y) {
            y[0] = -0.75 * x[0] + 150 * x[1] - 0.02 * x[2] + 6 * x[3];
            y[1] = 0.25 * x[0] - 60 * x[1] - 0.04 * x[2] + 9 * x[3];
            y[2] = 0.5 * x[0] - 90 * x[1] - 0.02 * x[2] + 3 * x[3];
            y[3] = x[2] + 0 * x[0];
          }),
          {{-0.05}}),
      // HS28 with its row a second time, scaled.
      Row("HS28, row repeated", {-4, 1, 1}, Each(3, kFree), {{1, 1}, {0.7, 0.7}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] + x[1]) + Square(x[1] + x[2]);
            y[1] = x[0] + 2 * x[1] + 3 * x[2];
            y[2] = 0.7 * y[1];
          }),
          {{0}}),
      // HS71 with an equality that its third repeats.
      Row("HS71, rows repeated", {1, 5, 5, 1}, Each(4, {1, 5}), {{25, kNone}, {40, 40}, {40 / 3.0, 40 / 3.0}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
            y[1] = x[0] * x[1] * x[2] * x[3];
            y[2] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
            y[3] = y[2] / 3;
          }),
          {{17.0140173}}),
      // The gradient of the row vanishes at the only feasible x.
      Row("square is zero", {1, 1}, Each(2, kFree), {kZero}, Written([](const auto* x, auto* y) {
            y[0] = x[0] + Square(x[1] - 1);
            y[1] = x[0] * x[0];
          }),
          {{0},
           1e-4,
           "a violation of 1e-8 leaves x within 1e-4; without multipliers the error of 1e-8 is not reached",
           Termination::kAcceptable,
           Termination::kAcceptable}),
      // One of two is zero: no interior, no constraint qualification at any feasible point.
      Row("complementarity", {0.4, 0.7}, Each(2, kPositive), {{-kNone, 0}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[1] - 2);
            y[1] = x[0] * x[1];
          }),
          {{1}}),
      // Two circles that touch.
      Row("touching circles", {0.2, 0.8}, Each(2, kFree), {{1, 1}, {1, 1}}, Written([](const auto* x, auto* y) {
            y[0] = x[0] + x[1];
            y[1] = Square(x[0] - 1) + x[1] * x[1];
            y[2] = Square(x[0] + 1) + x[1] * x[1];
          }),
          {{0}, 1e-3, "a violation of 1e-8 leaves points within 1e-4 of the one where they touch"}),
      // Wächter and Biegler, Math. Program. 88, 2000: methods that take Newton steps shortened by bounds alone end
      // where
      // nothing is stationary. Restoration ends at (-1, 0, 0), where the sum of violations has a local minimum.
      Row("Wachter-Biegler", {-2, 3, 1}, {kFree, kPositive, kPositive}, {{1, 1}, {0.5, 0.5}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0];
            y[1] = x[0] * x[0] - x[1];
            y[2] = x[0] - x[2];
          }),
          local),
      // The same on the side of its solution.
      Row("Wachter-Biegler, right", {2, 3, 1}, {kFree, kPositive, kPositive}, {{1, 1}, {0.5, 0.5}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0];
            y[1] = x[0] * x[0] - x[1];
            y[2] = x[0] - x[2];
          }),
          {{1}}),
  };
}

}  // namespace rollgait::suite
