#include "core/gait/mesh_continuation.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/gait/artefact.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"
#include "core/gait/power_smoothing.h"
#include "core/gait/rate_costs.h"
#include "core/gait/solver_settings.h"

namespace rollgait {
namespace {

// Intervals of a step. A full cycle has two: with as many intervals in all as a half cycle, of which phases of 2 and 4
// remained, squared torque and slopes led to motions that exist on that mesh only.
constexpr int kMostAtColdStart = 36;
constexpr int kOuterGroups = 6;           // of half the size, at each end of a phase
constexpr int kMostOfIntermediate = 200;  // iterations of what is only a start; those that succeed take 4 to 130

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

// How often the intervals of every phase are halved for a cold start to converge well.
int Halvings(const GaitSpec& spec) {
  // A phase has one interval at least, so many short phases have more in all however often they are halved.
  const int steps = spec.cycle == Cycle::kFull ? 2 : 1;
  const int fewest = std::max(steps * kMostAtColdStart, static_cast<int>(spec.phases.size()));
  int halvings = 0;
  for (GaitSpec next = spec; Intervals(next) > fewest; next = WithHalfTheIntervals(std::move(next))) ++halvings;
  return halvings;
}

// What only leads to the spec's solution.
GaitSpec Intermediate(GaitSpec spec) {
  // The legs must be on their sides before the mesh is fine.
  const double overlap = spec.bounds[Criterion::kOverlap];
  spec.bounds = NoBounds();
  spec.bounds[Criterion::kOverlap] = overlap;
  LeaveTheRest(&spec);
  return spec;
}

// How many of the requested intervals are put together in the group that has `place` others between itself and the end
// of its phase. With a price of rates alone the outermost ones are the requested intervals themselves, and the sizes
// double from there: what happens at touch-down and lift-off is learned while intervals are few. With a price of power
// that is too much at once (docs/explanation/accuracy.md).
int GroupSize(const GaitSpec& spec, int place, int inner) {
  if (!HasRates(spec) || LeastSmoothing(spec)) return place < kOuterGroups ? inner / 2 : inner;
  int size = 1;
  for (int i = 1; i < place && size < inner; ++i) size *= 2;
  return std::min(size, inner);
}

// The requested intervals put together by `inner`, a power of 2, and fewer towards the ends of each phase; what is left
// over in the middle of a phase is a group, too.
Mesh Grouped(const GaitSpec& spec, int inner) {
  Mesh mesh;
  for (const GaitSpec::Phase& phase : spec.phases) {
    std::vector<int> first, last;
    for (int left = phase.intervals; left > 0;) {
      const int size = GroupSize(spec, static_cast<int>(first.size()), inner);
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
  GaitSpec coarse = Intermediate(spec);
  coarse.max_iterations = std::min(spec.max_iterations, kMostOfIntermediate);
  for (int i = 0; i < halvings; ++i) coarse = WithHalfTheIntervals(std::move(coarse));
  return coarse;
}

GaitSolution SolveFromCoarse(const GaitSpec& spec, const OptimalControlProblem& problem, GaitSolution start,
                             SolveBudget* budget) {
  GaitSpec rough = Intermediate(spec);
  rough.kkt_tolerance = ToleranceOfStart(spec);
  rough.max_iterations = std::min(spec.max_iterations, kMostOfIntermediate);
  GaitSolution last = std::move(start);
  for (int halvings = std::max(Halvings(spec) - 1, 0); halvings >= 0; --halvings) {
    if (!Converged(last.termination)) return last;
    if (IsBeyondRefinement(spec, last)) {
      last.termination = Termination::kNumericalDifficulty;
      last.message = "Only motions that exist on a coarse mesh were found: they slip between its nodes.";
      return last;
    }
    const bool arrives = halvings == 0;
    Mesh mesh = arrives ? RequestedMesh(spec) : Grouped(spec, 1 << halvings);
    const bool leads_on = Intervals(mesh) > Intervals(*last.trajectory) && Intervals(mesh) < Intervals(spec);
    if (!arrives && !leads_on) continue;
    GaitSolution solution =
        SolveFromCoarser(arrives ? spec : rough, problem, StartFrom(spec, last), std::move(mesh), budget);
    solution.note = last.note;
    // Where an intermediate mesh does not converge, the next one starts from the one before it.
    if (!arrives && !Converged(solution.termination) && budget->Left()) continue;
    last = std::move(solution);
  }
  return last;
}

}  // namespace rollgait
