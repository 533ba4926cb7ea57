// A block that a force moves by 1 m in 1 s from rest to rest with least ∫ u² dt: u = 6 − 12 t, cost 12.
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem BlockMove() {
  KnownProblem known;
  known.answer = {"block move", 12};
  known.problem = CoordinatesWithFormula({{true}}, [](const FormulaPoint& z) { return std::vector<Jet>{z.u(0)}; });
  known.problem->phases[0].duration = {1, 1};
  PrescribeEnds(known.problem.get(), {0, 0}, {1, 0});
  AddCost(known.problem.get(), 12, [](const FormulaPoint& z) { return z.u(0) * z.u(0); });
  known.guess = StraightGuess({1}, {0, 0}, {1, 0}, {0});
  for (const SchemeTraits& traits : Schemes()) {
    if (traits.effort_degree < 1) continue;
    known.runs.push_back({traits.scheme, Mesh::Uniform({4})});  // efforts are linear: exact
  }
  return known;
}

}  // namespace rollgait
