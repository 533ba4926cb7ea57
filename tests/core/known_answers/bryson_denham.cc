// Bryson and Denham's double integrator ẍ = u that returns to where it was with the opposite velocity, in 1 s, and may
// not go beyond 1/9 in between: x(0) = x(1) = 0, ẋ = 1 → −1, least ½ ∫ u² dt. With ℓ = 1/9 the bound holds from 3ℓ to
// 1 − 3ℓ, u = −(2/3ℓ)(1 − t/3ℓ) before, and the cost is 4/(9ℓ) = 4 (Bryson and Ho, Applied Optimal Control).
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem BrysonDenham() {
  KnownProblem known;
  known.answer = {"Bryson-Denham", 4};
  known.problem = CoordinatesWithFormula({{true, {}, {-kInfinity, 1.0 / 9}}},
                                         [](const FormulaPoint& z) { return std::vector<Jet>{z.u(0)}; });
  known.problem->phases = {{{}, {0.1, 0.9}}, {{}, {0.1, 0.9}}, {{}, {0.1, 0.9}}};
  known.problem->duration = {1, 1};
  PrescribeEnds(known.problem.get(), {0, 1}, {0, -1});
  AddCost(known.problem.get(), 4, [](const FormulaPoint& z) { return 0.5 * z.u(0) * z.u(0); });
  // At the nodes alone the bound would let x go beyond it between them.
  known.added.between.resize(3);
  for (BoundedBetween& phase : known.added.between) phase.range = {0};
  known.guess = StraightGuess({0.3, 0.4, 0.3}, {0, 1}, {0, -1}, {0});
  for (const SchemeTraits& traits : Schemes()) {
    if (traits.effort_degree < 1) continue;
    known.runs.push_back({traits.scheme, Mesh::Uniform({1, 1, 1})});  // efforts are linear in every phase: exact
  }
  return known;
}

}  // namespace rollgait
