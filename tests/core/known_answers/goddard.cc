// Goddard's rocket (COPS 3, Dolan, Moré and Munson 2004): v̇ = (T − D)/m − 1/h², ṁ = −2 T, D = 310 v² exp(−500 (h − 1)),
// from h = 1, v = 0, m = 1 to m = 0.6 as high as it gets, 0 ≤ T ≤ 3.5, over a free duration. Full thrust, a singular
// arc and a free flight, whose durations are free. On the singular arc the thrust is constant within each interval:
// values that are free at every point alternate, and gain a height of first order in the intervals' length that does
// not exist. In units of 0.01 of the radius h = 1 and 0.1 of its unit of time, m is the velocity of the second
// coordinate, and the objective is minus the height gained.
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem Goddard() {
  KnownProblem known;
  // To 1e-9 of the height reached.
  known.answer = {"Goddard's rocket", -0.012836918317, 5e-13, 1e-9 * 1.012836918317 / 0.012836918317};
  known.problem = CoordinatesWithFormula({{true, {0, 3.5}}, {}}, [](const FormulaPoint& z) {
    const Jet drag = 3.1 * z.v(0) * z.v(0) * exp(-5 * z.q(0)), h = 1 + 0.01 * z.q(0);
    return std::vector<Jet>{(z.u(0) - drag) / z.v(1) - 1 / (h * h), -0.2 * z.u(0)};
  });
  known.problem->phases = {{{}, {0.05, 1}, {}, {{3.5, 3.5}}}, {{}, {0.05, 2}, 0}, {{}, {0.05, 4}, {}, {{0, 0}}}};
  PrescribeEnds(known.problem.get(), {0, 0, 0, 1}, {kFree, kFree, kFree, 0.6});
  AddCost(known.problem.get(), 0.01, [](const FormulaPoint& z) { return -0.01 * z.v(0); });
  known.guess = PiecewiseGuess({0.23, 0.5, 1.25},
                               {{0, 0, 0, 1}, {0.07, 0.2, 0.6, 0.84}, {0.5, 0.5, 1.2, 0.6}, {1.25, 1.3, 0, 0.6}},
                               {{3.5}, {2}, {0}});
  known.tolerance = 1e-9;
  known.runs = {{Scheme::kRadau2, Mesh::Uniform({2, 2, 2}), 4, 3, false},
                {Scheme::kHermiteSimpson, Mesh::Uniform({2, 2, 2}), 4, 4, false},
                {Scheme::kRadau3, Mesh::Uniform({2, 2, 2}), 4, 5}};
  return known;
}

}  // namespace rollgait
