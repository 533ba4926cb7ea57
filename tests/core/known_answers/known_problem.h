#ifndef ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_
#define ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/ocp/problem.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// What is known of a problem's least objective.
struct KnownAnswer {
  std::string problem;
  double objective = 0;
  double uncertainty = 0;  // of `objective` itself
  double asked = 1e-9;     // relative error
};

// A scheme on a coarse mesh, from the guess of the problem; then, `splits` times, on meshes that halve the intervals in
// which a control reaches or leaves a bound; then on meshes that halve all intervals. Each starts from the solution on
// the one before.
struct KnownRun {
  Scheme scheme = Scheme::kRadau3;
  Mesh coarse;
  int halvings = 0;
  // In which the objective's error falls in the last halving, where the solution is smooth within intervals.
  std::optional<double> order = std::nullopt;
  bool reaches = true;  // the error that is asked; else the run is there for its order
  int splits = 0;
};

// A problem, where its solution is looked for, its known answer, and how it is put on meshes.
struct KnownProblem {
  KnownAnswer answer;
  std::unique_ptr<OptimalControlProblem> problem;
  AddedConstraints added;
  MotionGuess guess;
  double tolerance = 1e-10;  // of the solver; what rounding allows on the finest mesh
  std::vector<KnownRun> runs;
};

// One a source file, which says what it is.
KnownProblem BlockMove();
KnownProblem BrysonDenham();
KnownProblem Brachistochrone();
KnownProblem MoonLander();
KnownProblem Goddard();
KnownProblem VanDerPol();
KnownProblem CartPole();
KnownProblem Hypersensitive();
KnownProblem FiveLinkBiped();

// All of them, in this order.
std::vector<KnownProblem> KnownProblems();

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_KNOWN_ANSWERS_KNOWN_PROBLEM_H_
