#include "core/gait/optimizing_gait_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/mesh_sequence.h"

namespace rollgait {
namespace {

// A gait that is periodic leaves its momentum as it was: over a cycle the ground's mean force is the weight, which on a slope
// leans by the slope. Within the friction cone at every instant, the mean is within it too.
std::optional<UnmetConstraint> FindContradiction(const GaitSpec& spec) {
  const double needed = std::hypot(spec.gravity.x(), spec.gravity.y()) / std::abs(spec.gravity.z());
  if (needed <= spec.friction_coefficient) return std::nullopt;
  return UnmetConstraint{"friction, mean over the cycle", 0, 0, needed - spec.friction_coefficient, "1"};
}

void AppendMeshes(const GaitSolution& from, std::vector<MeshStatistics>* meshes) {
  meshes->insert(meshes->end(), from.meshes.begin(), from.meshes.end());
}

// The cheapest of what the first mesh finds from several guesses, then refined.
GaitSolution SolveFromStarts(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget) {
  const Mesh mesh = RequestedMesh(spec);
  GaitSpec trial = spec;
  trial.max_refinements = 0;
  std::optional<GaitSolution> best;
  std::vector<MeshStatistics> meshes;
  int found = 0, best_start = 0;
  for (int start = 0; start < spec.starts && budget->Left(); ++start) {
    GaitSolution solution = SolveOnMeshes(trial, problem, WalkingGuess(spec, problem, start), mesh, budget);
    AppendMeshes(solution, &meshes);
    if (!Converged(solution.termination)) continue;
    ++found;
    if (best && best->objective <= solution.objective) continue;
    best = std::move(solution);
    best_start = start;
  }
  if (!best) {  // the first guess once more, with the finer meshes that it may need
    GaitSolution solution = SolveOnMeshes(spec, problem, WalkingGuess(spec, problem), mesh, budget);
    AppendMeshes(solution, &meshes);
    solution.meshes = std::move(meshes);
    return solution;
  }
  const std::string note = " Cheapest of " + std::to_string(found) + " solutions from " + std::to_string(spec.starts) +
                           " starts (number " + std::to_string(best_start) + ").";
  if (spec.max_refinements > 0 && !best->within_requested_accuracy) {
    GaitSpec finer = spec;
    finer.max_refinements = spec.max_refinements - 1;
    GaitSolution solution = SolveOnMeshes(finer, problem, GuessFromTrajectory(*best->trajectory),
                                          RefineMesh(mesh, spec, *best->trajectory), budget);
    AppendMeshes(solution, &meshes);
    if (Converged(solution.termination)) {
      best = std::move(solution);
    } else {
      best->message += " The next finer mesh did not converge (" + solution.message + ")";
    }
  }
  best->meshes = std::move(meshes);
  best->message += note;
  best->wall_time = budget->elapsed();
  return std::move(*best);
}

GaitSpec AtSlope(const GaitSpec& spec, double slope) {
  GaitSpec other = spec;
  other.slope = slope;
  other.gravity = spec.gravity.norm() * Vector3(-std::sin(slope), 0, -std::cos(slope));
  return other;
}

// Walks from level ground to the slope of the request, each solution the guess of the next. Steps are halved where one does
// not converge. Returns nothing if that fails too.
std::optional<GaitSolution> SolveByContinuation(const GaitSpec& spec, SolveBudget* budget) {
  constexpr double kFirstStep = 5 * std::numbers::pi / 180, kLeastStep = kFirstStep / 8;
  GaitSpec level = AtSlope(spec, 0);
  level.max_refinements = 0;
  const auto level_problem = BuildProblem(level);
  GaitSolution last = SolveFromStarts(level, *level_problem, budget);
  std::vector<MeshStatistics> meshes = last.meshes;
  if (!Converged(last.termination)) return std::nullopt;
  const double direction = spec.slope > 0 ? 1 : -1, steepness = std::abs(spec.slope);
  double reached = 0, step = kFirstStep;
  while (reached < steepness && step >= kLeastStep && budget->Left()) {
    const double next = std::min(steepness, reached + step);
    const bool arrives = next == steepness;
    GaitSpec there = AtSlope(spec, direction * next);
    if (!arrives) there.max_refinements = 0;
    const auto problem = BuildProblem(there);
    GaitSolution solution = SolveOnMeshes(there, *problem, GuessFromTrajectory(*last.trajectory), RequestedMesh(spec), budget);
    AppendMeshes(solution, &meshes);
    if (!Converged(solution.termination)) {
      step /= 2;
      continue;
    }
    last = std::move(solution);
    reached = next;
  }
  if (reached < steepness) return std::nullopt;
  last.meshes = std::move(meshes);
  last.message += " Reached by continuation from level ground, where the start converges.";
  return last;
}

// From the requested starts, and on a slope that these do not reach by continuation.
GaitSolution Search(const GaitSpec& spec, SolveBudget* budget) {
  const auto problem = BuildProblem(spec);
  GaitSolution solution = spec.starts > 1
                              ? SolveFromStarts(spec, *problem, budget)
                              : SolveOnMeshes(spec, *problem, WalkingGuess(spec, *problem), RequestedMesh(spec), budget);
  if (Converged(solution.termination) || spec.slope == 0 || !budget->Left()) return solution;
  std::optional<GaitSolution> continued = SolveByContinuation(spec, budget);
  if (!continued) return solution;
  continued->meshes.insert(continued->meshes.begin(), solution.meshes.begin(), solution.meshes.end());
  return std::move(*continued);
}

}  // namespace

GaitSolution OptimizingGaitSolver::Solve(const GaitSpec& spec, const SolveControl& control) {
  SolveBudget budget(spec, control);
  if (const auto contradiction = FindContradiction(spec)) {
    GaitSolution solution;
    solution.termination = Termination::kInfeasible;
    solution.message = "No gait can meet the request: without sliding, the ground must carry the weight at this slope.";
    solution.unmet_constraints = {*contradiction};
    return solution;
  }
  GaitSolution solution = Search(spec, &budget);
  if (solution.trajectory) solution.normative = CompareWithPeople(spec.scene, *solution.trajectory, spec.gravity);
  return solution;
}

}  // namespace rollgait
