#include "tests/core/known_answers/solve_known.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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
  options.tolerance = known.tolerance;
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

// Which bound an effort is at.
enum class Side { kLower, kNone, kUpper };
Side SideOf(double effort, const Joint& joint) {
  const double near = 1e-6 * std::max(1.0, std::abs(effort));
  if (effort < joint.effort_min + near) return Side::kLower;
  return effort > joint.effort_max - near ? Side::kUpper : Side::kNone;
}

// The mesh with those intervals halved at whose points, or between whose first one and the point before it, an effort
// changes its side.
Mesh SplitAtBounds(const OptimalControlProblem& problem, const KnownSolution& solution) {
  const Trajectory trajectory = solution.nlp->Extract(solution.result.x.data());
  const std::vector<int>& actuated = problem.model.actuated();
  Mesh mesh;
  std::vector<std::optional<Side>> last(actuated.size());
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    std::vector<double>& fractions = mesh.fractions.emplace_back();
    int point = 0;
    for (const double fraction : solution.nlp->mesh().fractions[p]) {
      bool changes = false;
      for (int i = 0; i < trajectory.points_per_interval; ++i, ++point) {
        for (size_t a = 0; a < actuated.size(); ++a) {
          const double effort = trajectory.phases[p].point_efforts(static_cast<int>(a), point);
          const Side side = SideOf(effort, problem.model.joint(actuated[a]));
          changes |= last[a].value_or(side) != side;
          last[a] = side;
        }
      }
      const int parts = changes ? 2 : 1;
      fractions.insert(fractions.end(), static_cast<size_t>(parts), fraction / parts);
    }
  }
  return mesh;
}

}  // namespace

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
  for (int step = -run.splits; step <= run.halvings; ++step) {
    const KnownSolution& last = solutions.back();
    const Mesh mesh = step < 0 ? SplitAtBounds(*known.problem, last) : Halved(last.nlp->mesh());
    solutions.push_back(SolveKnown(known, run.scheme, mesh, &last));
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
