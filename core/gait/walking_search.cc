#include "core/gait/walking_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/meshes.h"

namespace rollgait {
namespace {

void AppendMeshes(const GaitSolution& from, std::vector<MeshStatistics>* meshes) {
  meshes->insert(meshes->end(), from.meshes.begin(), from.meshes.end());
}

GaitSpec AtSlope(const GaitSpec& spec, double slope) {
  GaitSpec other = spec;
  other.slope = slope;
  other.gravity = spec.gravity.norm() * Vector3(-std::sin(slope), 0, -std::cos(slope));
  return other;
}

}  // namespace

GaitSolution SolveFromStarts(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget) {
  const Mesh mesh = RequestedMesh(spec);
  GaitSpec trial = spec;
  trial.max_refinements = 0;
  std::optional<GaitSolution> best;
  GaitSolution last;
  std::vector<MeshStatistics> meshes;
  int tried = 0, found = 0, best_start = 0;
  while (tried < spec.starts && budget->Left()) {
    const int start = tried++;
    GaitSolution solution = SolveOnMeshes(trial, problem, WalkingGuess(spec, problem, start), mesh, budget);
    AppendMeshes(solution, &meshes);
    const bool converged = Converged(solution.termination);
    if (solution.termination == Termination::kCancelled || (!converged && !best && !budget->Left())) {
      solution.meshes = std::move(meshes);
      return solution;
    }
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
    if (spec.max_refinements == 0) {
      last.meshes = std::move(meshes);
      return last;
    }
    // The first guess once more, with the finer meshes that it may need.
    GaitSolution solution = SolveOnMeshes(spec, problem, WalkingGuess(spec, problem), mesh, budget);
    AppendMeshes(solution, &meshes);
    solution.meshes = std::move(meshes);
    return solution;
  }
  const std::string note = " Cheapest of " + std::to_string(found) + " solutions from " + std::to_string(tried) +
                           " starts (number " + std::to_string(best_start) + ").";
  if (spec.max_refinements > 0 && best->verdict.kind == Verdict::Kind::kExceeded) {
    GaitSpec finer = spec;
    finer.max_refinements = spec.max_refinements - 1;
    GaitSolution solution = SolveOnMeshes(finer, problem, GuessFromTrajectory(*best->trajectory),
                                          RefineMesh(mesh, spec, *best->trajectory, *best->accuracy, false), budget);
    AppendMeshes(solution, &meshes);
    if (Converged(solution.termination)) {
      best = std::move(solution);
    } else {
      best->message += " The next finer mesh did not converge (" + solution.message + ")";
    }
  }
  best->meshes = std::move(meshes);
  best->note = note;
  best->wall_time = budget->elapsed();
  return std::move(*best);
}

std::optional<GaitSolution> SolveByContinuation(const GaitSpec& spec, SolveBudget* budget,
                                                std::vector<MeshStatistics>* meshes) {
  constexpr double kFirstStep = 5 * std::numbers::pi / 180, kLeastStep = kFirstStep / 8;
  GaitSpec level = AtSlope(spec, 0);
  LeaveTheRest(&level);
  const auto level_problem = BuildProblem(level);
  GaitSolution last = SolveFromStarts(level, *level_problem, budget);
  AppendMeshes(last, meshes);
  if (!Converged(last.termination)) return std::nullopt;
  const double direction = spec.slope > 0 ? 1 : -1, steepness = std::abs(spec.slope);
  double reached = 0, step = kFirstStep;
  while (reached < steepness && step >= kLeastStep && budget->Left()) {
    const double next = std::min(steepness, reached + step);
    const bool arrives = next == steepness;
    GaitSpec there = AtSlope(spec, direction * next);
    if (!arrives) LeaveTheRest(&there);
    const auto problem = BuildProblem(there);
    GaitSolution solution =
        SolveOnMeshes(there, *problem, GuessFromTrajectory(*last.trajectory), RequestedMesh(spec), budget);
    AppendMeshes(solution, meshes);
    if (!Converged(solution.termination)) {
      step /= 2;
      continue;
    }
    last = std::move(solution);
    reached = next;
  }
  if (reached < steepness) return std::nullopt;
  last.note = " Reached by continuation from level ground, where the start converges.";
  return last;
}

}  // namespace rollgait
