// The swing-up of a cart-pole (Kelly, SIAM Review 59, 2017): cart of 1 kg, bob of 0.3 kg on
// a rod of 0.5 m, g = 9.81 m/s², from rest at q = (0, 0) to rest at (1 m, π) in 2 s with |u| ≤ 20 N, least ∫ u² dt.
#include <cmath>

#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem CartPole() {
  KnownProblem known;
  known.answer = {"cart-pole", 58.8076675, 1e-7, 1e-8};
  known.problem = CoordinatesWithFormula({{true, {-20, 20}}, {}}, [](const FormulaPoint& z) {
    const double m1 = 1, m2 = 0.3, l = 0.5, g = 9.81;
    const Jet s = sin(z.q(1)), c = cos(z.q(1)), w = z.v(1), d = m1 + m2 * s * s;
    return std::vector<Jet>{(l * m2 * s * w * w + z.u(0) + m2 * g * c * s) / d,
                            -(l * m2 * c * s * w * w + z.u(0) * c + (m1 + m2) * g * s) / (l * d)};
  });
  known.problem->phases[0].duration = {2, 2};
  PrescribeEnds(known.problem.get(), {0, 0, 0, 0}, {1, M_PI, 0, 0});
  AddCost(known.problem.get(), 60, [](const FormulaPoint& z) { return z.u(0) * z.u(0); });
  known.guess = StraightGuess({2}, {0, 0, 0, 0}, {1, M_PI, 0, 0}, {0});
  known.tolerance = 1e-9;
  known.runs = {{Scheme::kRadau2, Mesh::Uniform({40}), 2, 3, false},
                {Scheme::kHermiteSimpson, Mesh::Uniform({20}), 3, 4, false},
                {Scheme::kRadau3, Mesh::Uniform({20}), 2, 5, false},
                {Scheme::kRadau3, Mesh::Uniform({45}), 2}};
  return known;
}

}  // namespace rollgait
