// Optimal control problems with known answers through our transcription and solver: known_answers [NAME ...]
// Definitions, meshes and references are those of the tests (tests/core/known_answers). Each row is one run; its error
// is relative, and so is the error bar; order is that of the last halving where the solution is smooth within
// intervals. Exit code 1 if a solve does not converge or an error is beyond its bar.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/core/known_answers/solve_known.h"

namespace rollgait {
namespace {

int TotalOf(const Mesh& mesh) {
  int total = 0;
  for (const auto& phase : mesh.fractions) total += static_cast<int>(phase.size());
  return total;
}

bool Print(const KnownProblem& known, const KnownRun& run) {
  const KnownError measured = MeasureError(known, run);
  const KnownSolution& last = measured.solutions.back();
  int iterations = 0;
  double seconds = 0;
  for (const KnownSolution& solution : measured.solutions) {
    iterations += solution.result.iterations;
    seconds += solution.result.wall_time_s;
  }
  char order[16] = "";
  if (run.order) std::snprintf(order, sizeof order, "%.2f", measured.order);
  std::printf("| %s | %s, %d | %.12g | %.14g | %.1e | %.1e | %s | %d | %.2f |%s\n", known.answer.problem.c_str(),
              TraitsOf(run.scheme).name, TotalOf(last.nlp->mesh()), last.objective, known.answer.objective,
              measured.error, measured.bar, order, iterations, seconds, measured.converged ? "" : " not converged");
  std::fflush(stdout);
  return measured.converged &&
         measured.error <= measured.bar + known.answer.uncertainty / std::abs(known.answer.objective);
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) {
  const std::vector<std::string> asked(argv + 1, argv + argc);
  std::printf("| problem | scheme, intervals | value | reference | error | error bar | order | iterations | s |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const rollgait::KnownProblem& known : rollgait::KnownProblems()) {
    if (!asked.empty() && std::find(asked.begin(), asked.end(), known.answer.problem) == asked.end()) continue;
    for (const rollgait::KnownRun& run : known.runs) good &= rollgait::Print(known, run);
  }
  return good ? 0 : 1;
}
