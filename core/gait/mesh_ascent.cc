#include "core/gait/mesh_ascent.h"

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
  GaitSpec unbounded = spec;
  unbounded.max_gap = unbounded.max_slip = kInfinity;
  unbounded.max_refinements = 0;
  std::vector<GaitSpec> coarser;
  while (Intervals(coarser.empty() ? unbounded : coarser.back()) > kMostFromAfar) {
    coarser.push_back(WithHalfTheIntervals(coarser.empty() ? unbounded : coarser.back()));
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
