// Problems 1 to 42 of Hock and Schittkowski, Test Examples for Nonlinear Programming Codes, Lecture Notes in Economics
// and Mathematical Systems 187, Springer 1981: functions, starts and optimal values.
#include <cmath>

#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {
namespace {

template <typename T>
T Rosenbrock(const T* x) {
  return 100 * Square(x[1] - x[0] * x[0]) + Square(1 - x[0]);
}

}  // namespace

std::vector<SuiteRow> HockSchittkowskiSmall() {
  const double pi = std::acos(-1.0), root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);
  return {
      Row("HS1", {-2, 1}, {kFree, {-1.5, kNone}}, {}, Written([](const auto* x, auto* y) { y[0] = Rosenbrock(x); }),
          {{0}}),
      Row("HS3", {10, 1}, {kFree, kPositive}, {},
          Written([](const auto* x, auto* y) { y[0] = x[1] + 1e-5 * Square(x[1] - x[0]); }), {{0}}),
      Row("HS4", {1.125, 0.125}, {{1, kNone}, kPositive}, {},
          Written([](const auto* x, auto* y) { y[0] = Power(x[0] + 1, 3) / 3 + x[1]; }), {{8.0 / 3}}),
      Row("HS5", {0, 0}, {{-1.5, 4}, {-3, 3}}, {}, Written([](const auto* x, auto* y) {
            y[0] = sin(x[0] + x[1]) + Square(x[0] - x[1]) - 1.5 * x[0] + 2.5 * x[1] + 1;
          }),
          {{-root3 / 2 - pi / 3}}),
      Row("HS6", {-1.2, 1}, Each(2, kFree), {kZero}, Written([](const auto* x, auto* y) {
            y[0] = Square(1 - x[0]);
            y[1] = 10 * (x[1] - x[0] * x[0]);
          }),
          {{0}}),
      Row("HS7", {2, 2}, Each(2, kFree), {{4, 4}}, Written([](const auto* x, auto* y) {
            y[0] = log(1 + x[0] * x[0]) - x[1];
            y[1] = Square(1 + x[0] * x[0]) + x[1] * x[1];
          }),
          {{-root3}}),
      Row("HS8", {2, 1}, Each(2, kFree), {{25, 25}, {9, 9}}, Written([](const auto* x, auto* y) {
            y[0] = -1 + 0 * x[0];
            y[1] = x[0] * x[0] + x[1] * x[1];
            y[2] = x[0] * x[1];
          }),
          {{-1}}),
      Row("HS9", {0, 0}, Each(2, kFree), {kZero}, Written([](const auto* x, auto* y) {
            y[0] = sin(3.14159265358979323846 / 12 * x[0]) * cos(3.14159265358979323846 / 16 * x[1]);
            y[1] = 4 * x[0] - 3 * x[1];
          }),
          {{-0.5}}),
      Row("HS10", {-10, 10}, Each(2, kFree), {{-1, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = x[0] - x[1];
            y[1] = -3 * x[0] * x[0] + 2 * x[0] * x[1] - x[1] * x[1];
          }),
          {{-1}}),
      Row("HS11", {4.9, 0.1}, Each(2, kFree), {kPositive}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 5) + x[1] * x[1] - 25;
            y[1] = x[1] - x[0] * x[0];
          }),
          {{-8.498464223}}),
      Row("HS12", {0, 0}, Each(2, kFree), {{-25, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 0.5 * x[0] * x[0] + x[1] * x[1] - x[0] * x[1] - 7 * x[0] - 7 * x[1];
            y[1] = -4 * x[0] * x[0] - x[1] * x[1];
          }),
          {{-30}}),
      Row("HS14", {2, 2}, Each(2, kFree), {{-1, kNone}, {-1, -1}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 2) + Square(x[1] - 1);
            y[1] = -0.25 * x[0] * x[0] - x[1] * x[1];
            y[2] = x[0] - 2 * x[1];
          }),
          {{9 - 2.875 * std::sqrt(7.0)}}),
      Row("HS15", {-2, 1}, {{-kNone, 0.5}, kFree}, {{1, kNone}, kPositive}, Written([](const auto* x, auto* y) {
            y[0] = Rosenbrock(x);
            y[1] = x[0] * x[1];
            y[2] = x[0] + x[1] * x[1];
          }),
          {{306.5}}),
      Row("HS16", {-2, 1}, {{-0.5, 0.5}, {-kNone, 1}}, Each(2, kPositive), Written([](const auto* x, auto* y) {
            y[0] = Rosenbrock(x);
            y[1] = x[0] + x[1] * x[1];
            y[2] = x[0] * x[0] + x[1];
          }),
          {{0.25, 100 * Square(root2 / 2 - 0.25) + 2.25}, 1e-6, "both end at the local minimum (-1/2, sqrt(1/2))"}),
      Row("HS17", {-2, 1}, {{-0.5, 0.5}, {-kNone, 1}}, Each(2, kPositive), Written([](const auto* x, auto* y) {
            y[0] = Rosenbrock(x);
            y[1] = x[1] * x[1] - x[0];
            y[2] = x[0] * x[0] - x[1];
          }),
          {{1}}),
      Row("HS18", {2, 2}, {{2, 50}, {0, 50}}, Each(2, {25, kNone}), Written([](const auto* x, auto* y) {
            y[0] = 0.01 * x[0] * x[0] + x[1] * x[1];
            y[1] = x[0] * x[1];
            y[2] = x[0] * x[0] + x[1] * x[1];
          }),
          {{5}}),
      Row("HS19", {20.1, 5.84}, {{13, 100}, {0, 100}}, {{100, kNone}, {-82.81, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = Power(x[0] - 10, 3) + Power(x[1] - 20, 3);
            y[1] = Square(x[0] - 5) + Square(x[1] - 5);
            y[2] = -Square(x[1] - 5) - Square(x[0] - 6);
          }),
          {{-6961.81381}}),
      Row("HS20", {-2, 1}, {{-0.5, 0.5}, kFree}, {kPositive, kPositive, {1, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = Rosenbrock(x);
            y[1] = x[0] + x[1] * x[1];
            y[2] = x[0] * x[0] + x[1];
            y[3] = x[0] * x[0] + x[1] * x[1];
          }),
          {{81.5 - 25 * root3, 100 * Square(root3 / 2 - 0.25) + 2.25},
           1e-6,
           "both end at the local minimum (-1/2, sqrt(3/4))"}),
      Row("HS21", {-1, -1}, {{2, 50}, {-50, 50}}, {{10, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 0.01 * x[0] * x[0] + x[1] * x[1] - 100;
            y[1] = 10 * x[0] - x[1];
          }),
          {{-99.96}}),
      Row("HS22", {2, 2}, Each(2, kFree), {{-2, kNone}, kPositive}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 2) + Square(x[1] - 1);
            y[1] = -x[0] - x[1];
            y[2] = x[1] - x[0] * x[0];
          }),
          {{1}}),
      Row("HS23", {3, 1}, Each(2, {-50, 50}), {{1, kNone}, {1, kNone}, {9, kNone}, kPositive, kPositive},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[0] + x[1] * x[1];
            y[1] = x[0] + x[1];
            y[2] = x[0] * x[0] + x[1] * x[1];
            y[3] = 9 * x[0] * x[0] + x[1] * x[1];
            y[4] = x[0] * x[0] - x[1];
            y[5] = x[1] * x[1] - x[0];
          }),
          {{2}}),
      Row("HS24", {1, 0.5}, Each(2, kPositive), {kPositive, kPositive, {-6, kNone}},
          Written([](const auto* x, auto* y) {
            const double r = std::sqrt(3.0);
            y[0] = (Square(x[0] - 3) - 9) * Power(x[1], 3) / (27 * r);
            y[1] = x[0] / r - x[1];
            y[2] = x[0] + r * x[1];
            y[3] = -x[0] - r * x[1];
          }),
          {{-1}}),
      Row("HS26", {-2.6, 2, 2}, Each(3, kFree), {{3, 3}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Power(x[1] - x[2], 4);
            y[1] = (1 + x[1] * x[1]) * x[0] + Power(x[2], 4);
          }),
          {{0}}),
      Row("HS27", {2, 2, 2}, Each(3, kFree), {{-1, -1}}, Written([](const auto* x, auto* y) {
            y[0] = 0.01 * Square(x[0] - 1) + Square(x[1] - x[0] * x[0]);
            y[1] = x[0] + x[2] * x[2];
          }),
          {.values = {0.04}, .restores = Restores::kYes}),
      Row("HS28", {-4, 1, 1}, Each(3, kFree), {{1, 1}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] + x[1]) + Square(x[1] + x[2]);
            y[1] = x[0] + 2 * x[1] + 3 * x[2];
          }),
          {{0}}),
      Row("HS29", {1, 1, 1}, Each(3, kFree), {{-48, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = -x[0] * x[1] * x[2];
            y[1] = -x[0] * x[0] - 2 * x[1] * x[1] - 4 * x[2] * x[2];
          }),
          {{-16 * root2}}),
      Row("HS30", {1, 1, 1}, {{1, 10}, {-10, 10}, {-10, 10}}, {{1, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
            y[1] = x[0] * x[0] + x[1] * x[1];
          }),
          {{1}}),
      Row("HS31", {1, 1, 1}, {{-10, 10}, {1, 10}, {-10, 1}}, {{1, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 9 * x[0] * x[0] + x[1] * x[1] + 9 * x[2] * x[2];
            y[1] = x[0] * x[1];
          }),
          {{6}}),
      Row("HS32", {0.1, 0.7, 0.2}, Each(3, kPositive), {{3, kNone}, {1, 1}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] + 3 * x[1] + x[2]) + 4 * Square(x[0] - x[1]);
            y[1] = 6 * x[1] + 4 * x[2] - Power(x[0], 3);
            y[2] = x[0] + x[1] + x[2];
          }),
          {{1}}),
      Row("HS33", {0, 0, 3}, {kPositive, kPositive, {0, 5}}, {kPositive, {4, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = (x[0] - 1) * (x[0] - 2) * (x[0] - 3) + x[2];
            y[1] = x[2] * x[2] - x[1] * x[1] - x[0] * x[0];
            y[2] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
          }),
          {{root2 - 6}}),
      Row("HS34", {0, 1.05, 2.9}, {{0, 100}, {0, 100}, {0, 10}}, Each(2, kPositive),
          Written([](const auto* x, auto* y) {
            y[0] = -x[0];
            y[1] = x[1] - exp(x[0]);
            y[2] = x[2] - exp(x[1]);
          }),
          {{-std::log(std::log(10.0))}}),
      Row("HS35", {0.5, 0.5, 0.5}, Each(3, kPositive), {{-3, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * x[0] * x[0] + 2 * x[1] * x[1] + x[2] * x[2] +
                   2 * x[0] * x[1] + 2 * x[0] * x[2];
            y[1] = -x[0] - x[1] - 2 * x[2];
          }),
          {{1.0 / 9}}),
      Row("HS36", {10, 10, 10}, {{0, 20}, {0, 11}, {0, 42}}, {{-72, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = -x[0] * x[1] * x[2];
            y[1] = -x[0] - 2 * x[1] - 2 * x[2];
          }),
          {{-3300}}),
      Row("HS37", {10, 10, 10}, Each(3, {0, 42}), {{0, 72}}, Written([](const auto* x, auto* y) {
            y[0] = -x[0] * x[1] * x[2];
            y[1] = x[0] + 2 * x[1] + 2 * x[2];
          }),
          {{-3456}}),
      Row("HS38", {-3, -1, -3, -1}, Each(4, {-10, 10}), {}, Written([](const auto* x, auto* y) {
            y[0] = Rosenbrock(x) + 90 * Square(x[3] - x[2] * x[2]) + Square(1 - x[2]) +
                   10.1 * (Square(x[1] - 1) + Square(x[3] - 1)) + 19.8 * (x[1] - 1) * (x[3] - 1);
          }),
          {{0}}),
      Row("HS39", {2, 2, 2, 2}, Each(4, kFree), Each(2, kZero), Written([](const auto* x, auto* y) {
            y[0] = -x[0];
            y[1] = x[1] - Power(x[0], 3) - x[2] * x[2];
            y[2] = x[0] * x[0] - x[1] - x[3] * x[3];
          }),
          {{-1}}),
      Row("HS40", {0.8, 0.8, 0.8, 0.8}, Each(4, kFree), {{1, 1}, kZero, kZero}, Written([](const auto* x, auto* y) {
            y[0] = -x[0] * x[1] * x[2] * x[3];
            y[1] = Power(x[0], 3) + x[1] * x[1];
            y[2] = x[0] * x[0] * x[3] - x[2];
            y[3] = x[3] * x[3] - x[1];
          }),
          {{-0.25}}),
      Row("HS41", {2, 2, 2, 2}, {{0, 1}, {0, 1}, {0, 1}, {0, 2}}, {kZero}, Written([](const auto* x, auto* y) {
            y[0] = 2 - x[0] * x[1] * x[2];
            y[1] = x[0] + 2 * x[1] + 2 * x[2] - x[3];
          }),
          {{52.0 / 27}}),
      Row("HS42", {1, 1, 1, 1}, Each(4, kFree), Each(2, {2, 2}), Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[1] - 2) + Square(x[2] - 3) + Square(x[3] - 4);
            y[1] = x[0] + 0 * x[1];
            y[2] = x[2] * x[2] + x[3] * x[3];
          }),
          {{28 - 10 * root2}}),
  };
}

}  // namespace rollgait::suite
