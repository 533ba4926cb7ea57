#include "core/gait/mesh_ascent.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/gait/mesh_sequence.h"

namespace rollgait {
namespace {

constexpr int kMostFromAfar = 36;  // intervals in all

int Intervals(const GaitSpec& spec) {
  int sum = 0;
  for (const GaitSpec::Phase& phase : spec.phases) sum += phase.intervals;
  return sum;
}

int Intervals(const Trajectory& trajectory) {
  size_t sum = 0;
  for (const TrajectoryPhase& phase : trajectory.phases) sum += phase.node_times.size() - 1;
  return static_cast<int>(sum);
}

GaitSpec WithHalfTheIntervals(GaitSpec spec) {
  for (GaitSpec::Phase& phase : spec.phases) phase.intervals = (phase.intervals + 1) / 2;
  return spec;
}

// The spec on meshes that only lead to others, coarsest last.
std::vector<GaitSpec> CoarserOnes(const GaitSpec& spec) {
  // A phase has one interval at least, so many short phases have more in all however often they are halved.
  const int fewest = std::max(kMostFromAfar, static_cast<int>(spec.phases.size()));
  GaitSpec next = spec;
  next.max_gap = next.max_slip = kInfinity;
  next.max_refinements = 0;
  std::vector<GaitSpec> coarser;
  while (Intervals(next) > fewest) {
    next = WithHalfTheIntervals(std::move(next));
    coarser.push_back(next);
  }
  return coarser;
}

}  // namespace

std::optional<GaitSpec> CoarseStart(const GaitSpec& spec) {
  std::vector<GaitSpec> coarser = CoarserOnes(spec);
  if (coarser.empty()) return std::nullopt;
  return std::move(coarser.back());
}

GaitSolution Ascend(const GaitSpec& spec, const OptimalControlProblem& problem, GaitSolution start, SolveBudget* budget) {
  std::vector<GaitSpec> steps = CoarserOnes(spec);
  steps.insert(steps.begin(), spec);
  GaitSolution last = std::move(start);
  while (!steps.empty()) {
    if (!Converged(last.termination)) return last;
    if (LeadsAstray(spec, last)) {
      last.termination = Termination::kNumericalDifficulty;
      last.message = "Only motions that exist on a coarse mesh were found: they slip between its nodes.";
      return last;
    }
    while (steps.size() > 1 && Intervals(steps.back()) <= Intervals(*last.trajectory)) steps.pop_back();
    GaitSolution solution = SolveFromCoarser(steps.back(), problem, {*last.trajectory, last.multipliers}, budget);
    steps.pop_back();
    solution.note = last.note;
    PutBefore(last.meshes, &solution);
    last = std::move(solution);
  }
  return last;
}

}  // namespace rollgait
