#ifndef ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_FORMULA_PROBLEM_H_
#define ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_FORMULA_PROBLEM_H_

#include <memory>
#include <vector>

#include "core/ocp/problem.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/support/formula.h"

namespace rollgait {

// A coordinate of a problem that moves by a formula. A state with a first derivative only is the velocity of one.
struct Coordinate {
  bool controlled = false;  // carries a control
  Interval control = {};
  Interval position = {};
};

// A problem between given ends whose coordinates move by a formula, in units of its own. One phase, no denominator: the
// caller sets what it needs.
std::unique_ptr<OptimalControlProblem> CoordinatesWithFormula(const std::vector<Coordinate>& coordinates,
                                                              FormulaOfMotion::Accelerations f);
void AddCost(OptimalControlProblem* problem, double typical, FormulaCost::Integrand integrand);
// (q, v) at both ends, infinite where free.
void PrescribeEnds(OptimalControlProblem* problem, const std::vector<double>& start, const std::vector<double>& end);
inline constexpr double kFree = kInfinity;

// States (q, v) that run from one to the other through all phases on a straight line, with constant controls.
MotionGuess StraightGuess(std::vector<double> durations, std::vector<double> start, std::vector<double> end,
                          std::vector<double> controls);
// The same with states at both ends of every phase, in this order, straight lines between them, and controls that are
// constant in every phase.
MotionGuess PiecewiseGuess(std::vector<double> durations, std::vector<std::vector<double>> states,
                           std::vector<std::vector<double>> controls);

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_FORMULA_PROBLEM_H_
