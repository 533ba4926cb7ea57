// ẋ = −x³ + u from 1.5 to 1 in 50 s, least ½ ∫ x² + u² dt (Rao and Mease, Automatica 35, 1999): x decays, stays at 0
// and rises again, both within some seconds. x is the velocity of the coordinate.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {
namespace {

// Of one phase: intervals that grow from both ends to the middle, each by the ratio.
Mesh GradedToEnds(int intervals, double ratio) {
  std::vector<double> lengths;
  double total = 0;
  for (int k = 0; k < intervals; ++k) total += lengths.emplace_back(std::pow(ratio, std::min(k, intervals - 1 - k)));
  for (double& length : lengths) length /= total;
  return {{lengths}};
}

}  // namespace

KnownProblem Hypersensitive() {
  KnownProblem known;
  known.answer = {"hypersensitive", 1.330806905, 1e-9};
  known.problem = CoordinatesWithFormula(
      {{true}}, [](const FormulaPoint& z) { return std::vector<Jet>{-z.v(0) * z.v(0) * z.v(0) + z.u(0)}; });
  known.problem->phases[0].duration = {50, 50};
  PrescribeEnds(known.problem.get(), {0, 1.5}, {kFree, 1});
  AddCost(known.problem.get(), 1, [](const FormulaPoint& z) { return 0.5 * (z.v(0) * z.v(0) + z.u(0) * z.u(0)); });
  known.guess = StraightGuess({50}, {0, 1.5}, {10, 1}, {0});
  known.tolerance = 1e-9;
  const Mesh mesh = GradedToEnds(28, 1.4);
  known.runs = {{Scheme::kRadau2, mesh, 2, 3, false},
                {Scheme::kHermiteSimpson, mesh, 2, 4, false},
                {Scheme::kRadau3, mesh, 3, 5}};
  return known;
}

}  // namespace rollgait
