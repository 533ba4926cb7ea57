// Van der Pol's oscillator ẋ₁ = (1 − x₂²) x₁ − x₂ + u, ẋ₂ = x₁ from (0, 1), least ∫ x₁² + x₂² + u² dt over 5 s with
// −0.3 ≤ u ≤ 1.
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem VanDerPol() {
  KnownProblem known;
  known.answer = {"van der Pol", 2.86726105, 1e-8, 1e-8};
  known.problem = CoordinatesWithFormula({{true, {-0.3, 1}}}, [](const FormulaPoint& z) {
    return std::vector<Jet>{(1 - z.q(0) * z.q(0)) * z.v(0) - z.q(0) + z.u(0)};
  });
  known.problem->phases[0].duration = {5, 5};
  PrescribeEnds(known.problem.get(), {1, 0}, {kFree, kFree});
  AddCost(known.problem.get(), 1,
          [](const FormulaPoint& z) { return z.v(0) * z.v(0) + z.q(0) * z.q(0) + z.u(0) * z.u(0); });
  known.guess = StraightGuess({5}, {1, 0}, {0, 0}, {0});
  known.tolerance = 1e-8;
  // The control is at its bounds up to 0.05 s and from 1.05 to 1.43 s, which no mesh has as nodes: no order is seen.
  known.runs = {{Scheme::kRadau2, Mesh::Uniform({40}), 2, {}, false, 4},
                {Scheme::kHermiteSimpson, Mesh::Uniform({20}), 2, {}, true, 4},
                {Scheme::kRadau3, Mesh::Uniform({20}), 2, {}, true, 4}};
  return known;
}

}  // namespace rollgait
