// Problems of CUTE (Bongartz, Conn, Gould and Toint, ACM TOMS 21, 1995) with the optimal values that their SIF files
// print. The minimax problems are those of their collections with one unknown more, which bounds the functions.
#include <cmath>

#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {

std::vector<SuiteRow> CuteRows() {
  return {
      // Maratos, 1978: a full step towards the solution raises both the objective and the violation.
      Row("MARATOS", {1.1, 0.1}, Each(2, kFree), {{1, 1}}, Written([](const auto* x, auto* y) {
            const auto square = x[0] * x[0] + x[1] * x[1];
            y[0] = -x[0] + 1e-6 * (square - 1);
            y[1] = square;
          }),
          {{-1}}),
      // Nocedal and Wright, Numerical Optimization, example 15.4, on the circle itself.
      Row("MARATOS-NW", {std::cos(0.3), std::sin(0.3)}, Each(2, kFree), {{1, 1}}, Written([](const auto* x, auto* y) {
            const auto square = x[0] * x[0] + x[1] * x[1];
            y[0] = 2 * (square - 1) - x[0];
            y[1] = square;
          }),
          {{-1}}),
      Row("BT1", {0.08, 0.06}, Each(2, kFree), {{1, 1}}, Written([](const auto* x, auto* y) {
            const auto square = x[0] * x[0] + x[1] * x[1];
            y[0] = 100 * square - x[0] - 100;
            y[1] = square;
          }),
          {{-1}}),
      Row("BT12", {15.811, 1.5811, 0, 15.083, 3.7164}, Each(5, kFree), {{25, 25}, {25, 25}, {2, 2}},
          Written([](const auto* x, auto* y) {
            y[0] = 0.01 * x[0] * x[0] + x[1] * x[1];
            y[1] = x[0] + x[1] - x[2] * x[2];
            y[2] = x[0] * x[0] + x[1] * x[1] - x[3] * x[3];
            y[3] = x[0] - x[4] * x[4];
          }),
          {{6.188119}}),
      Row("BYRDSPHR", {5, 0.0001, -0.0001}, Each(3, kFree), Each(2, {9, 9}), Written([](const auto* x, auto* y) {
            y[0] = -x[0] - x[1] - x[2];
            y[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
            y[2] = Square(x[0] - 1) + x[1] * x[1] + x[2] * x[2];
          }),
          {{-4.68330013}}),
      Row("ALSOTAME", {0, 0}, {{-2, 2}, {-1.5, 1.5}}, {{1, 1}}, Written([](const auto* x, auto* y) {
            y[0] = exp(x[0] - 2 * x[1]);
            y[1] = sin(-x[0] + x[1] - 1) + 1;
          }),
          {{0.0820849986}}),
      Row("CB2", {2, 2, 0}, Each(3, kFree), Each(3, kPositive), Written([](const auto* x, auto* y) {
            y[0] = x[2];
            y[1] = x[2] - x[0] * x[0] - Power(x[1], 4);
            y[2] = x[2] - Square(2 - x[0]) - Square(2 - x[1]);
            y[3] = x[2] - 2 * exp(x[1] - x[0]);
          }),
          {{1.9522245}}),
      Row("CB3", {2, 2, 0}, Each(3, kFree), Each(3, kPositive), Written([](const auto* x, auto* y) {
            y[0] = x[2];
            y[1] = x[2] - Power(x[0], 4) - x[1] * x[1];
            y[2] = x[2] - Square(2 - x[0]) - Square(2 - x[1]);
            y[3] = x[2] - 2 * exp(x[1] - x[0]);
          }),
          {{2}}),
      Row("MAKELA1", {0, 0, 0}, Each(3, kFree), Each(2, kPositive), Written([](const auto* x, auto* y) {
            const auto square = x[0] * x[0] + x[1] * x[1];
            y[0] = x[2];
            y[1] = x[2] + x[0] + x[1];
            y[2] = x[2] + x[0] + x[1] - square + 1;
          }),
          {{-std::sqrt(2.0)}}),
      Row("DEMYMALO", {1, 1, 0}, Each(3, kFree), Each(3, kPositive), Written([](const auto* x, auto* y) {
            y[0] = x[2];
            y[1] = x[2] - 5 * x[0] - x[1];
            y[2] = x[2] + 5 * x[0] - x[1];
            y[3] = x[2] - x[0] * x[0] - x[1] * x[1] - 4 * x[1];
          }),
          {{-3}}),
      Row("POLAK1", {50, 0.05, 0}, Each(3, kFree), Each(2, kPositive), Written([](const auto* x, auto* y) {
            y[0] = x[2];
            y[1] = x[2] - exp(1e-3 * x[0] * x[0] + Square(x[1] - 1));
            y[2] = x[2] - exp(1e-3 * x[0] * x[0] + Square(x[1] + 1));
          }),
          {{std::exp(1.0)}}),
      Row("ROSENMMX", {0, 0, 0, 0, 0}, Each(5, kFree), Each(4, kPositive), Written([](const auto* x, auto* y) {
            const auto a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2], d = x[3] * x[3];
            const auto f = a + b + 2 * c + d - 5 * x[0] - 5 * x[1] - 21 * x[2] + 7 * x[3];
            y[0] = x[4];
            y[1] = x[4] - f;
            y[2] = x[4] - f + 10 * (8 - a - b - c - d - x[0] + x[1] - x[2] + x[3]);
            y[3] = x[4] - f + 10 * (10 - a - 2 * b - c - 2 * d + x[0] + x[3]);
            y[4] = x[4] - f + 10 * (5 - 2 * a - b - c - 2 * x[0] + x[1] + x[3]);
          }),
          {{-44}}),
  };
}

}  // namespace rollgait::suite
