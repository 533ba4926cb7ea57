#include "core/gait/multistart.h"

#include <optional>
#include <string>
#include <utility>

#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"

namespace rollgait {
GaitSolution SolveFromStarts(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget) {
  const Mesh mesh = RequestedMesh(spec);
  GaitSpec trial = spec;
  trial.max_refinements = 0;
  std::optional<GaitSolution> best;
  GaitSolution last;
  int tried = 0, found = 0, best_start = 0;
  while (tried < spec.starts && budget->Left()) {
    const int start = tried++;
    GaitSolution solution = SolveOnMeshes(trial, problem, WalkingGuess(spec, problem, start), mesh, budget);
    const bool converged = Converged(solution.termination);
    if (solution.termination == Termination::kCancelled || (!converged && !best && !budget->Left())) return solution;
    if (!converged) {
      last = std::move(solution);
      continue;
    }
    ++found;
    if (best && best->objective <= solution.objective) continue;
    best = std::move(solution);
    best_start = start;
  }
  if (!best) {
    if (spec.max_refinements == 0) return last;
    // The first guess once more, with the finer meshes that it may need.
    return SolveOnMeshes(spec, problem, WalkingGuess(spec, problem), mesh, budget);
  }
  const std::string note = " Cheapest of " + std::to_string(found) + " solutions from " + std::to_string(tried) +
                           " starts (number " + std::to_string(best_start) + ").";
  if (spec.max_refinements > 0 && best->verdict.kind == Verdict::Kind::kExceeded) {
    GaitSpec finer = spec;
    finer.max_refinements = spec.max_refinements - 1;
    GaitSolution solution = SolveOnMeshes(finer, problem, GuessFromTrajectory(*best->trajectory),
                                          RefineMesh(mesh, spec, *best->trajectory, *best->accuracy, false), budget);
    if (Converged(solution.termination)) {
      best = std::move(solution);
    } else {
      best->message += " The next finer mesh did not converge (" + solution.message + ")";
    }
  }
  best->note = note;
  best->wall_time = budget->elapsed();
  return std::move(*best);
}

}  // namespace rollgait
