#include "tests/core/known_answers/solve_known.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/nlp/interior_point.h"
#include "core/nlp/ipopt_solver.h"

namespace rollgait {
namespace {

// Part of an objective that the solver's tolerance and rounding leave open.
constexpr double kRounding = 2e-11;

NlpResult Solve(CollocationNlp& nlp, const KnownProblem& known, const KnownSolution* from, KnownSolver solver) {
  NlpOptions options;
  options.tolerance = 1e-10;
  NlpStart start;
  if (from != nullptr) {
    start.x = nlp.MakeStart(GuessFromTrajectory(from->nlp->Extract(from->result.x.data())));
    nlp.TransferMultipliers(*from->nlp, from->result, &start);
    options.initial_barrier = options.warm_push = 1e-5;
  } else {
    start.x = nlp.MakeStart(known.guess);
  }
  if (solver == KnownSolver::kIpopt) return SolveWithIpopt(nlp, start, options, {});
  InteriorPointResult own = SolveWithInteriorPoint(nlp, start, options, {});
  if (own.needs_restoration) own.result.termination = Termination::kNumericalDifficulty;
  return std::move(own.result);
}

}  // namespace

const char* NameOf(Scheme scheme) {
  switch (scheme) {
    case Scheme::kRadau2:
      return "Radau-2";
    case Scheme::kRadau3:
      return "Radau-3";
    case Scheme::kHermiteSimpson:
      return "Hermite–Simpson";
  }
  return "";
}

KnownSolution SolveKnown(const KnownProblem& known, Scheme scheme, const Mesh& mesh, const KnownSolution* from,
                         KnownSolver solver) {
  KnownSolution solution;
  solution.nlp = std::make_unique<CollocationNlp>(*known.problem, scheme, mesh, known.added);
  solution.result = Solve(*solution.nlp, known, from, solver);
  const double* x = solution.result.x.data();
  const VectorX integrals = solution.nlp->CostIntegrals(x);
  for (size_t t = 0; t < known.problem->costs.size(); ++t) {
    solution.objective += known.problem->costs[t].weight * integrals(static_cast<int>(t));
  }
  solution.objective /= solution.nlp->Denominator(x);
  return solution;
}

KnownError MeasureError(const KnownProblem& known, const KnownRun& run) {
  KnownError measured;
  std::vector<KnownSolution>& solutions = measured.solutions;
  solutions.push_back(SolveKnown(known, run.scheme, run.coarse));
  for (int halving = 0; halving <= run.halvings; ++halving) {
    const KnownSolution& last = solutions.back();
    solutions.push_back(SolveKnown(known, run.scheme, Halved(last.nlp->mesh()), &last));
  }
  for (const KnownSolution& solution : solutions) {
    measured.converged &= solution.result.termination == Termination::kOptimal;
  }
  measured.halved = std::move(solutions.back());
  solutions.pop_back();
  const double exact = known.answer.objective, size = std::abs(exact);
  const auto error = [&](const KnownSolution& solution) { return std::abs(solution.objective - exact) / size; };
  measured.error = error(solutions.back());
  measured.bar = 2 * std::abs(solutions.back().objective - measured.halved.objective) / size + kRounding;
  measured.order = run.halvings > 0 ? std::log2(error(solutions[solutions.size() - 2]) / measured.error)
                                    : std::numeric_limits<double>::quiet_NaN();
  return measured;
}

}  // namespace rollgait
