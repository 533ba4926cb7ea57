#ifndef ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_
#define ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_

#include <memory>
#include <string>
#include <vector>

#include "core/ocp/problem.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/support/formula.h"

namespace rollgait {

// What is known of a problem's least objective.
struct KnownAnswer {
  std::string problem;
  double objective = 0;
  double uncertainty = 0;  // of `objective` itself
  double asked = 1e-9;     // relative error
};

// A problem, where its solution is looked for, and its known answer.
struct KnownProblem {
  KnownAnswer answer;
  std::unique_ptr<OptimalControlProblem> problem;
  MotionGuess guess;
};

// A problem between given ends whose n coordinates move by a formula; the first `efforts` of them carry the controls.
// Unbounded in everything, one phase, no denominator: the caller sets what it needs.
std::unique_ptr<OptimalControlProblem> CoordinatesWithFormula(int n, int efforts, FormulaOfMotion::Accelerations f);
void AddCost(OptimalControlProblem* problem, double typical, FormulaCost::Integrand integrand);
// (q, v) at both ends, infinite where free.
void PrescribeEnds(OptimalControlProblem* problem, const std::vector<double>& start, const std::vector<double>& end);
inline constexpr double kFree = kInfinity;

// States (q, v) that run from one to the other through all phases on a straight line, with constant efforts.
MotionGuess StraightGuess(std::vector<double> durations, std::vector<double> start, std::vector<double> end,
                          std::vector<double> efforts);

// A computed objective and what it took. Fails the test where the interior point method did not end at an optimum or
// wanted a restoration phase.
struct Computed {
  double objective = 0;
  int iterations = 0;
  double seconds = 0;
  Trajectory trajectory;
};
Computed SolveOnce(const KnownProblem& known, Scheme scheme, const Mesh& mesh, const MotionGuess& guess);

// Solves on a mesh and on the halved one. The error bar is what the two differ by, times 2^p / (2^p − 1) for the order
// p of the scheme, and the share of rounding. Expects the error against the known answer to be as asked and within the
// bar, the bar not to exceed what is asked, and prints both.
Computed ExpectKnownAnswer(const KnownProblem& known, Scheme scheme, const Mesh& mesh);

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_
