#include "core/gait/mesh_ascent.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"

namespace rollgait {
namespace {

constexpr int kMostFromAfar = 36;         // intervals in all
constexpr int kOuterGroups = 6;           // finer intervals at each end of a phase
constexpr double kRoughTolerance = 1e-2;  // of what is only a start

int Intervals(const GaitSpec& spec) {
  int sum = 0;
  for (const GaitSpec::Phase& phase : spec.phases) sum += phase.intervals;
  return sum;
}

int Intervals(const Mesh& mesh) {
  size_t sum = 0;
  for (const std::vector<double>& phase : mesh.fractions) sum += phase.size();
  return static_cast<int>(sum);
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

// How often the intervals of every phase are halved to be solved well from afar.
int Halvings(const GaitSpec& spec) {
  // A phase has one interval at least, so many short phases have more in all however often they are halved.
  const int fewest = std::max(kMostFromAfar, static_cast<int>(spec.phases.size()));
  int halvings = 0;
  for (GaitSpec next = spec; Intervals(next) > fewest; next = WithHalfTheIntervals(std::move(next))) ++halvings;
  return halvings;
}

// What only leads to the spec's solution.
GaitSpec OnTheWay(GaitSpec spec) {
  spec.max_gap = spec.max_slip = kInfinity;
  spec.max_refinements = 0;
  return spec;
}

// The requested intervals put together by `inner`, but the first and the last kOuterGroups groups of each phase by `outer`; what is
// left over in the middle of a phase is a group, too.
Mesh Grouped(const GaitSpec& spec, int inner, int outer) {
  Mesh mesh;
  for (const GaitSpec::Phase& phase : spec.phases) {
    std::vector<int> first, last;
    for (int left = phase.intervals; left > 0;) {
      const int size = static_cast<int>(first.size()) < kOuterGroups ? outer : inner;
      for (std::vector<int>* side : {&first, &last}) {
        const int group = std::min(size, left);
        if (group > 0) side->push_back(group);
        left -= group;
      }
    }
    first.insert(first.end(), last.rbegin(), last.rend());
    std::vector<double>& fractions = mesh.fractions.emplace_back();
    for (const int group : first) fractions.push_back(static_cast<double>(group) / phase.intervals);
  }
  return mesh;
}

}  // namespace

std::optional<GaitSpec> CoarseStart(const GaitSpec& spec) {
  const int halvings = Halvings(spec);
  if (halvings == 0) return std::nullopt;
  GaitSpec coarse = OnTheWay(spec);
  for (int i = 0; i < halvings; ++i) coarse = WithHalfTheIntervals(std::move(coarse));
  return coarse;
}

GaitSolution Ascend(const GaitSpec& spec, const OptimalControlProblem& problem, GaitSolution start, SolveBudget* budget) {
  GaitSpec rough = OnTheWay(spec);
  rough.kkt_tolerance = std::max(spec.kkt_tolerance, kRoughTolerance);
  GaitSolution last = std::move(start);
  for (int halvings = std::max(Halvings(spec) - 1, 0); halvings >= 0; --halvings) {
    if (!Converged(last.termination)) return last;
    if (LeadsAstray(spec, last)) {
      last.termination = Termination::kNumericalDifficulty;
      last.message = "Only motions that exist on a coarse mesh were found: they slip between its nodes.";
      return last;
    }
    const bool arrives = halvings == 0;
    Mesh mesh = arrives ? RequestedMesh(spec) : Grouped(spec, 1 << halvings, 1 << (halvings - 1));
    const bool leads_on = Intervals(mesh) > Intervals(*last.trajectory) && Intervals(mesh) < Intervals(spec);
    if (!arrives && !leads_on) continue;
    GaitSolution solution =
        SolveFromCoarser(arrives ? spec : rough, problem, {*last.trajectory, last.multipliers}, std::move(mesh), budget);
    solution.note = last.note;
    PutBefore(last.meshes, &solution);
    last = std::move(solution);
  }
  return last;
}

}  // namespace rollgait
