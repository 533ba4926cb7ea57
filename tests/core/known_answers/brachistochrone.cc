// A bead that slides without friction from (0, 10) to (10, 5) m in the least time: ẋ = s sin θ, ẏ = −s cos θ,
// ṡ = g cos θ. All states have a first derivative only, and the formula bends in velocities and controls.
#include <numbers>

#include "core/ocp/costs/point_costs.h"
#include "tests/core/known_answers/formula_problem.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {

KnownProblem Brachistochrone() {
  KnownProblem known;
  known.answer = {"brachistochrone", 1.80160312245308};
  known.problem = CoordinatesWithFormula({{true}, {}, {}}, [](const FormulaPoint& z) {
    return std::vector<Jet>{z.v(2) * sin(z.u(0)), -z.v(2) * cos(z.u(0)), 9.80665 * cos(z.u(0))};
  });
  known.problem->phases[0].duration = {0.1, 10};
  PrescribeEnds(known.problem.get(), {0, 0, 0, 0, 10, 0}, {kFree, kFree, kFree, 10, 5, kFree});
  CostDescription time;
  time.term = std::make_unique<TimeCost>();
  known.problem->costs.push_back(std::move(time));
  // As in Dymos's example of this problem, the bead turns from 5° to 100.5°. From a constant angle neither this solver
  // nor Ipopt comes to an end on all of these meshes.
  known.guess = StraightGuess({2}, {0, 0, 0, 0, 10, 0}, {10, 15, 10, 10, 5, 9}, {0});
  known.guess.motion = [straight = known.guess.motion](int phase, double fraction) {
    constexpr double kDegree = std::numbers::pi / 180;
    MotionSample sample = straight(phase, fraction);
    sample.efforts(0) = (5 + fraction * (100.5 - 5)) * kDegree;
    return sample;
  };
  known.runs = {{Scheme::kRadau2, Mesh::Uniform({10}), 2, 3, false},
                {Scheme::kHermiteSimpson, Mesh::Uniform({10}), 2, 4, false},
                {Scheme::kRadau3, Mesh::Uniform({8}), 2, 5},
                {Scheme::kLobatto4, Mesh::Uniform({3}), 2, 6},
                {Scheme::kRadau4, Mesh::Uniform({2}), 2, 7},
                {Scheme::kLobatto5, Mesh::Uniform({2}), 2, 8},
                {Scheme::kRadau5, Mesh::Uniform({1}), 2}};
  return known;
}

}  // namespace rollgait
