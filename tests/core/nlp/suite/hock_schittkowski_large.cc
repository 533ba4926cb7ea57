// Problems 43 to 113 of Hock and Schittkowski, Test Examples for Nonlinear Programming Codes, Lecture Notes in
// Economics and Mathematical Systems 187, Springer 1981: functions, starts and optimal values.
#include <cmath>

#include "tests/core/nlp/suite/suite_row.h"

namespace rollgait::suite {

std::vector<SuiteRow> HockSchittkowskiLarge() {
  const double root2 = std::sqrt(2.0);
  return {
      Row("HS43", {0, 0, 0, 0}, Each(4, kFree), {{-8, kNone}, {-10, kNone}, {-5, kNone}},
          Written([](const auto* x, auto* y) {
            const auto a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2], d = x[3] * x[3];
            y[0] = a + b + 2 * c + d - 5 * x[0] - 5 * x[1] - 21 * x[2] + 7 * x[3];
            y[1] = -a - b - c - d - x[0] + x[1] - x[2] + x[3];
            y[2] = -a - 2 * b - c - 2 * d + x[0] + x[3];
            y[3] = -2 * a - b - c - 2 * x[0] + x[1] + x[3];
          }),
          {{-44}}),
      Row("HS44", {0, 0, 0, 0}, Each(4, kPositive),
          {{-8, kNone}, {-12, kNone}, {-12, kNone}, {-8, kNone}, {-8, kNone}, {-5, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] - x[1] - x[2] - x[0] * x[2] + x[0] * x[3] + x[1] * x[2] - x[1] * x[3];
            y[1] = -x[0] - 2 * x[1];
            y[2] = -4 * x[0] - x[1];
            y[3] = -3 * x[0] - 4 * x[1];
            y[4] = -2 * x[2] - x[3];
            y[5] = -x[2] - 2 * x[3];
            y[6] = -x[2] - x[3];
          }),
          {{-15, -13}, 1e-6, "both end at the vertex (3, 0, 4, 0), a local minimum"}),
      Row("HS46", {root2 / 2, 1.75, 0.5, 2, 2}, Each(5, kFree), {{1, 1}, {2, 2}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[2] - 1) + Power(x[3] - 1, 4) + Power(x[4] - 1, 6);
            y[1] = x[0] * x[0] * x[3] + sin(x[3] - x[4]);
            y[2] = x[1] + Power(x[2], 4) * x[3] * x[3];
          }),
          {{0}}),
      Row("HS48", {3, 5, -3, 2, -2}, Each(5, kFree), {{5, 5}, {-3, -3}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[1] - x[2]) + Square(x[3] - x[4]);
            y[1] = x[0] + x[1] + x[2] + x[3] + x[4];
            y[2] = x[2] - 2 * (x[3] + x[4]);
          }),
          {{0}}),
      Row("HS49", {10, 7, 2, -3, 0.8}, Each(5, kFree), {{7, 7}, {6, 6}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[2] - 1) + Power(x[3] - 1, 4) + Power(x[4] - 1, 6);
            y[1] = x[0] + x[1] + x[2] + 4 * x[3];
            y[2] = x[2] + 5 * x[4];
          }),
          {{0}}),
      Row("HS50", {35, -31, 11, 5, -5}, Each(5, kFree), Each(3, {6, 6}), Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[1] - x[2]) + Power(x[2] - x[3], 4) + Square(x[3] - x[4]);
            for (int r = 0; r < 3; ++r) y[1 + r] = x[r] + 2 * x[r + 1] + 3 * x[r + 2];
          }),
          {{0}}),
      Row("HS51", {2.5, 0.5, 2, -1, 0.5}, Each(5, kFree), {{4, 4}, kZero, kZero}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[1] + x[2] - 2) + Square(x[3] - 1) + Square(x[4] - 1);
            y[1] = x[0] + 3 * x[1];
            y[2] = x[2] + x[3] - 2 * x[4];
            y[3] = x[1] - x[4];
          }),
          {{0}}),
      Row("HS52", {2, 2, 2, 2, 2}, Each(5, kFree), Each(3, kZero), Written([](const auto* x, auto* y) {
            y[0] = Square(4 * x[0] - x[1]) + Square(x[1] + x[2] - 2) + Square(x[3] - 1) + Square(x[4] - 1);
            y[1] = x[0] + 3 * x[1];
            y[2] = x[2] + x[3] - 2 * x[4];
            y[3] = x[1] - x[4];
          }),
          {{1859.0 / 349}}),
      Row("HS53", {2, 2, 2, 2, 2}, Each(5, {-10, 10}), Each(3, kZero), Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[1] + x[2] - 2) + Square(x[3] - 1) + Square(x[4] - 1);
            y[1] = x[0] + 3 * x[1];
            y[2] = x[2] + x[3] - 2 * x[4];
            y[3] = x[1] - x[4];
          }),
          {{176.0 / 43}}),
      Row("HS60", {2, 2, 2}, Each(3, {-10, 10}), {{4 + 3 * root2, 4 + 3 * root2}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[0] - x[1]) + Power(x[1] - x[2], 4);
            y[1] = x[0] * (1 + x[1] * x[1]) + Power(x[2], 4);
          }),
          {{0.03256820025}}),
      Row("HS61", {0, 0, 0}, Each(3, kFree), {{7, 7}, {11, 11}}, Written([](const auto* x, auto* y) {
            y[0] = 4 * x[0] * x[0] + 2 * x[1] * x[1] + 2 * x[2] * x[2] - 33 * x[0] + 16 * x[1] - 24 * x[2];
            y[1] = 3 * x[0] - 2 * x[1] * x[1];
            y[2] = 4 * x[0] - x[2] * x[2];
          }),
          {.values = {-143.6461422, -81.9190960946},
           .why = "the rows give x₁ and x₂ by x₀ but for their signs; with x₁ > 0 the second is the minimum; restores "
                  "with "
                  "-O3, not with -O1 and sanitizers",
           .restores = Restores::kByRounding}),
      Row("HS62", {0.7, 0.2, 0.1}, Each(3, {0, 1}), {{1, 1}}, Written([](const auto* x, auto* y) {
            const auto c = x[2] + 0.03, b = x[1] + c, a = x[0] + b;
            y[0] = -32.174 * (255 * log(a / (0.09 * x[0] + b)) + 280 * log(b / (0.07 * x[1] + c)) +
                              290 * log(c / (0.13 * x[2] + 0.03)));
            y[1] = x[0] + x[1] + x[2];
          }),
          {{-26272.51448}}),
      Row("HS63", {2, 2, 2}, Each(3, kPositive), {{56, 56}, {25, 25}}, Written([](const auto* x, auto* y) {
            y[0] = 1000 - x[0] * x[0] - 2 * x[1] * x[1] - x[2] * x[2] - x[0] * x[1] - x[0] * x[2];
            y[1] = 8 * x[0] + 14 * x[1] + 7 * x[2];
            y[2] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
          }),
          {{961.7151721}}),
      Row("HS64", {1, 1, 1}, Each(3, {1e-5, kNone}), {{-1, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 5 * x[0] + 50000 / x[0] + 20 * x[1] + 72000 / x[1] + 10 * x[2] + 144000 / x[2];
            y[1] = -4 / x[0] - 32 / x[1] - 120 / x[2];
          }),
          {{6299.842428}}),
      Row("HS65", {-5, 5, 0}, {{-4.5, 4.5}, {-4.5, 4.5}, {-5, 5}}, {{-48, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - x[1]) + Square(x[0] + x[1] - 10) / 9 + Square(x[2] - 5);
            y[1] = -x[0] * x[0] - x[1] * x[1] - x[2] * x[2];
          }),
          {.values = {0.9535288567}, .restores = Restores::kYes}),
      Row("HS66", {0, 1.05, 2.9}, {{0, 100}, {0, 100}, {0, 10}}, Each(2, kPositive),
          Written([](const auto* x, auto* y) {
            y[0] = 0.2 * x[2] - 0.8 * x[0];
            y[1] = x[1] - exp(x[0]);
            y[2] = x[2] - exp(x[1]);
          }),
          {{0.5181632741}}),
      Row("HS71", {1, 5, 5, 1}, Each(4, {1, 5}), {{25, kNone}, {40, 40}}, Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
            y[1] = x[0] * x[1] * x[2] * x[3];
            y[2] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
          }),
          {{17.0140173}}),
      Row("HS72", {1, 1, 1, 1}, {{0.001, 4e5}, {0.001, 3e5}, {0.001, 2e5}, {0.001, 1e5}},
          {{-0.0401, kNone}, {-0.010085, kNone}}, Written([](const auto* x, auto* y) {
            y[0] = 1 + x[0] + x[1] + x[2] + x[3];
            y[1] = -4 / x[0] - 2.25 / x[1] - 1 / x[2] - 0.25 / x[3];
            y[2] = -0.16 / x[0] - 0.36 / x[1] - 0.64 / x[2] - 0.64 / x[3];
          }),
          {{727.67937}}),
      Row("HS73", {1, 1, 1, 1}, Each(4, kPositive), {{5, kNone}, {21, kNone}, {1, 1}},
          Written([](const auto* x, auto* y) {
            y[0] = 24.55 * x[0] + 26.75 * x[1] + 39 * x[2] + 40.5 * x[3];
            y[1] = 2.3 * x[0] + 5.6 * x[1] + 11.1 * x[2] + 1.3 * x[3];
            y[2] = 12 * x[0] + 11.9 * x[1] + 41.8 * x[2] + 52.1 * x[3] -
                   1.645 * sqrt(0.28 * x[0] * x[0] + 0.19 * x[1] * x[1] + 20.5 * x[2] * x[2] + 0.62 * x[3] * x[3]);
            y[3] = x[0] + x[1] + x[2] + x[3];
          }),
          {{29.894378}}),
      Row("HS76", {0.5, 0.5, 0.5, 0.5}, Each(4, kPositive), {{-5, kNone}, {-4, kNone}, {1.5, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] - x[0] * x[2] + x[2] * x[3] -
                   x[0] - 3 * x[1] + x[2] - x[3];
            y[1] = -x[0] - 2 * x[1] - x[2] - x[3];
            y[2] = -3 * x[0] - x[1] - 2 * x[2] + x[3];
            y[3] = x[1] + 4 * x[2];
          }),
          {{-4.681818181}}),
      Row("HS77", {2, 2, 2, 2, 2}, Each(5, kFree), {{2 * root2, 2 * root2}, {8 + root2, 8 + root2}},
          Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[0] - x[1]) + Square(x[2] - 1) + Power(x[3] - 1, 4) + Power(x[4] - 1, 6);
            y[1] = x[0] * x[0] * x[3] + sin(x[3] - x[4]);
            y[2] = x[1] + Power(x[2], 4) * x[3] * x[3];
          }),
          {{0.24150513}}),
      Row("HS78", {-2, 1.5, 2, -1, -1}, Each(5, kFree), {{10, 10}, kZero, {-1, -1}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[1] * x[2] * x[3] * x[4];
            y[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[4] * x[4];
            y[2] = x[1] * x[2] - 5 * x[3] * x[4];
            y[3] = Power(x[0], 3) + Power(x[1], 3);
          }),
          {{-2.91970041}}),
      Row("HS79", {2, 2, 2, 2, 2}, Each(5, kFree),
          {{2 + 3 * root2, 2 + 3 * root2}, {2 * root2 - 2, 2 * root2 - 2}, {2, 2}}, Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 1) + Square(x[0] - x[1]) + Square(x[1] - x[2]) + Power(x[2] - x[3], 4) +
                   Power(x[3] - x[4], 4);
            y[1] = x[0] + x[1] * x[1] + Power(x[2], 3);
            y[2] = x[1] - x[2] * x[2] + x[3];
            y[3] = x[0] * x[4];
          }),
          {{0.0787768209}}),
      Row("HS80", {-2, 2, 2, -1, -1}, {{-2.3, 2.3}, {-2.3, 2.3}, {-3.2, 3.2}, {-3.2, 3.2}, {-3.2, 3.2}},
          {{10, 10}, kZero, {-1, -1}}, Written([](const auto* x, auto* y) {
            y[0] = exp(x[0] * x[1] * x[2] * x[3] * x[4]);
            y[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[4] * x[4];
            y[2] = x[1] * x[2] - 5 * x[3] * x[4];
            y[3] = Power(x[0], 3) + Power(x[1], 3);
          }),
          {{0.0539498478}}),
      Row("HS100", {1, 2, 0, 4, 0, 1, 1}, Each(7, kFree), {{-127, kNone}, {-282, kNone}, {-196, kNone}, kPositive},
          Written([](const auto* x, auto* y) {
            y[0] = Square(x[0] - 10) + 5 * Square(x[1] - 12) + Power(x[2], 4) + 3 * Square(x[3] - 11) +
                   10 * Power(x[4], 6) + 7 * x[5] * x[5] + Power(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
            y[1] = -2 * x[0] * x[0] - 3 * Power(x[1], 4) - x[2] - 4 * x[3] * x[3] - 5 * x[4];
            y[2] = -7 * x[0] - 3 * x[1] - 10 * x[2] * x[2] - x[3] + x[4];
            y[3] = -23 * x[0] - x[1] * x[1] - 6 * x[5] * x[5] + 8 * x[6];
            y[4] = -4 * x[0] * x[0] - x[1] * x[1] + 3 * x[0] * x[1] - 2 * x[2] * x[2] - 5 * x[5] + 11 * x[6];
          }),
          {{680.6300573}}),
      Row("HS106", {5000, 5000, 5000, 200, 350, 150, 225, 425},
          {{100, 1e4}, {1e3, 1e4}, {1e3, 1e4}, {10, 1e3}, {10, 1e3}, {10, 1e3}, {10, 1e3}, {10, 1e3}},
          {{-1, kNone}, {-1, kNone}, {-1, kNone}, {-83333.333, kNone}, kPositive, {1250000, kNone}},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] + x[1] + x[2];
            y[1] = -0.0025 * (x[3] + x[5]);
            y[2] = -0.0025 * (x[4] + x[6] - x[3]);
            y[3] = -0.01 * (x[7] - x[4]);
            y[4] = x[0] * x[5] - 833.33252 * x[3] - 100 * x[0];
            y[5] = x[1] * x[6] - 1250 * x[4] - x[1] * x[3] + 1250 * x[3];
            y[6] = x[2] * x[7] - x[2] * x[4] + 2500 * x[4];
          }),
          {{7049.248}, 1e-5, "published 7049.330923 is 8e-2 above what later papers print, 7049.248"}),
      Row("HS112", {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1}, Each(10, {1e-6, kNone}),
          {{2, 2}, {1, 1}, {1, 1}}, Written([](const auto* x, auto* y) {
            const double c[] = {-6.089, -17.164, -34.054, -5.914, -24.721, -14.986, -24.100, -10.708, -26.662, -22.179};
            auto sum = x[0];
            for (int i = 1; i < 10; ++i) sum = sum + x[i];
            y[0] = 0 * sum;
            for (int i = 0; i < 10; ++i) y[0] = y[0] + x[i] * (c[i] + log(x[i] / sum));
            y[1] = x[0] + 2 * x[1] + 2 * x[2] + x[5] + x[9];
            y[2] = x[3] + 2 * x[4] + x[5] + x[6];
            y[3] = x[2] + x[6] + x[7] + 2 * x[8] + x[9];
          }),
          {{-47.761}, 1e-5, "the value that later papers print, -47.761, has five digits"}),
      Row("HS113", {2, 3, 5, 5, 1, 2, 7, 3, 6, 10}, Each(10, kFree),
          {{-105, kNone}, kPositive, {-12, kNone}, {-120, kNone}, {-40, kNone}, {-30, kNone}, kPositive, kPositive},
          Written([](const auto* x, auto* y) {
            y[0] = x[0] * x[0] + x[1] * x[1] + x[0] * x[1] - 14 * x[0] - 16 * x[1] + Square(x[2] - 10) +
                   4 * Square(x[3] - 5) + Square(x[4] - 3) + 2 * Square(x[5] - 1) + 5 * x[6] * x[6] +
                   7 * Square(x[7] - 11) + 2 * Square(x[8] - 10) + Square(x[9] - 7) + 45;
            y[1] = -4 * x[0] - 5 * x[1] + 3 * x[6] - 9 * x[7];
            y[2] = -10 * x[0] + 8 * x[1] + 17 * x[6] - 2 * x[7];
            y[3] = 8 * x[0] - 2 * x[1] - 5 * x[8] + 2 * x[9];
            y[4] = -3 * Square(x[0] - 2) - 4 * Square(x[1] - 3) - 2 * x[2] * x[2] + 7 * x[3];
            y[5] = -5 * x[0] * x[0] - 8 * x[1] - Square(x[2] - 6) + 2 * x[3];
            y[6] = -0.5 * Square(x[0] - 8) - 2 * Square(x[1] - 4) - 3 * x[4] * x[4] + x[5];
            y[7] = -x[0] * x[0] - 2 * Square(x[1] - 2) + 2 * x[0] * x[1] - 14 * x[4] + 6 * x[5];
            y[8] = 3 * x[0] - 6 * x[1] - 12 * Square(x[8] - 8) + 7 * x[9];
          }),
          {{24.3062091}}),
  };
}

}  // namespace rollgait::suite
