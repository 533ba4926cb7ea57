// A soft landing with the least fuel: ḧ = T/m − g, ṁ = −T/c from h = 1, ḣ = −0.783, m = 1 to h = ḣ = 0, g = 1, c =
// 2.349, 0 ≤ T ≤ 1.227, least ∫ T dt over a free duration (Meditch, IEEE Trans. Automatic Control 9, 1964). The engine
// is off, and from one instant on at its limit. m is the velocity of the second coordinate.
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem MoonLander() {
  KnownProblem known;
  known.answer = {"moon lander", 1.42031259904920};
  known.problem = CoordinatesWithFormula({{true, {0, 1.227}}, {}}, [](const FormulaPoint& z) {
    return std::vector<Jet>{z.u(0) / z.v(1) - 1, -z.u(0) / 2.349};
  });
  known.problem->phases = {{{}, {0.01, 3}, 0}, {{}, {0.01, 3}, 0}};
  PrescribeEnds(known.problem.get(), {1, 0, -0.783, 1}, {0, kFree, 0, kFree});
  AddCost(known.problem.get(), 1, [](const FormulaPoint& z) { return z.u(0); });
  known.guess = StraightGuess({0.3, 1}, {1, 0, -0.783, 1}, {0, 1, 0, 0.4}, {0.8});
  known.runs = {{Scheme::kRadau2, Mesh::Uniform({2, 2}), 3, 3, false},
                {Scheme::kHermiteSimpson, Mesh::Uniform({1, 2}), 3, 4, false},
                {Scheme::kRadau3, Mesh::Uniform({1, 3}), 3, 5}};
  return known;
}

}  // namespace rollgait
