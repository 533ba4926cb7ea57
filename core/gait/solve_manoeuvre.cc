#include "core/gait/solve_manoeuvre.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/gait/artefact.h"
#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_continuation.h"
#include "core/gait/meshes.h"
#include "core/gait/rolling_path.h"

namespace rollgait {
namespace {

constexpr int kMostCharts = 4;  // that one sketch is carried through
constexpr double kEdge = 1e-3;  // rad
// Of nine reorientations of a ball, loops of this size (in semi-axes; 0.5 to 2 were tried) lead most often to the best
// motion that was found.
constexpr double kDetour = 1.1;
constexpr int kSides = 6;

struct Attempt {
  GaitSolution solution;
  bool within_chart = false;
  // Converged, within its chart, and a motion of the body: may be compared with others.
  bool valid = false;
};

// s. Prescribed, or that of a straight roll of least cost.
double GuessDuration(const GaitSpec& spec) {
  const GaitSpec::Phase& phase = spec.phases.front();
  double torque = 0, time = 0;
  for (const GaitSpec::CostTerm& term : spec.costs) {
    (std::holds_alternative<cost::Time>(term.term) ? time : torque) += term.weight;
  }
  double duration = phase.min_duration;
  if (time > 0) {
    // min 12 w I²θ²/T³ + w_t T
    duration = std::pow(36 * std::max(torque, 1e-12) * std::pow(TurningMoment(spec), 2) / time, 0.25);
  }
  return std::clamp(duration, phase.min_duration, phase.max_duration);
}

// Straight the short way round, straight the long way, and loops to all sides and in both senses. With a free end
// orientation nothing is gained by a detour.
std::vector<Detour> Detours(const GaitSpec& spec) {
  std::vector<Detour> detours = {{}};
  if (!spec.manoeuvre->end.orientation) return detours;
  detours.push_back({.long_way = true});
  const double size = kDetour * spec.scene.selection.rolling_body->semi_axes.mean();
  for (const double sense : {1.0, -1.0}) {
    for (int side = 0; side < kSides; ++side) {
      detours.push_back({size, side * 2 * std::numbers::pi / kSides, sense, false});
    }
  }
  return detours;
}

bool WithinChart(const Trajectory& trajectory) {
  const auto beta = trajectory.phases.front().node_positions.row(4);
  return beta.cwiseAbs().maxCoeff() < OrientationChart::kLargestTilt - kEdge;
}

// The spec with its scene in a chart, and the problem of going there with the turns of the path.
struct Charted {
  Charted(const GaitSpec& from, const RollingPath& path, const OrientationChart& chart) : spec(from) {
    spec.scene = InChart(from.scene, chart);
    problem = BuildProblem(spec);
    problem->ends = EndsInChart(*spec.manoeuvre, path, chart);
  }
  GaitSpec spec;
  std::unique_ptr<OptimalControlProblem> problem;
};

// One sketch on the requested mesh, carried through charts.
Attempt Try(const GaitSpec& spec, RollingPath path, SolveBudget* budget) {
  GaitSpec rough = spec;
  LeaveTheRest(&rough);
  rough.bounds = NoBounds();
  Attempt attempt;
  for (int k = 0; k < kMostCharts && budget->Left(); ++k) {
    const std::optional<OrientationChart> chart = ChooseChart(path);
    if (!chart) break;
    const Charted charted(rough, path, *chart);
    attempt.solution =
        SolveOnMeshes(charted.spec, *charted.problem, GuessInChart(path, *chart), RequestedMesh(spec), budget);
    attempt.solution.scene = charted.spec.scene;
    if (!attempt.solution.trajectory || !Converged(attempt.solution.termination)) break;
    attempt.within_chart = WithinChart(*attempt.solution.trajectory);
    attempt.valid = attempt.within_chart && !IsArtefact(spec, attempt.solution);
    if (attempt.within_chart) break;
    path = PathOf(charted.spec.scene, *attempt.solution.trajectory);
  }
  return attempt;
}

bool Better(const Attempt& a, const Attempt& b) {
  if (a.valid != b.valid) return a.valid;
  const bool finite_a = a.solution.trajectory.has_value(), finite_b = b.solution.trajectory.has_value();
  if (finite_a != finite_b) return finite_a;
  if (!a.valid) return a.solution.constraint_violation < b.solution.constraint_violation;
  return a.solution.objective < b.solution.objective;
}

// The best of all sketches, on the requested mesh.
Attempt FindBest(const GaitSpec& spec, SolveBudget* budget) {
  std::optional<Attempt> best;
  for (const Detour& detour : Detours(spec)) {
    if (best && !budget->Left()) break;
    Attempt attempt = Try(spec, SketchPath(spec, detour, GuessDuration(spec)), budget);
    if (!best || Better(attempt, *best)) best = std::move(attempt);
  }
  return std::move(*best);
}

// On finer meshes, in its chart.
GaitSolution Refine(const GaitSpec& spec, GaitSolution best, SolveBudget* budget) {
  const RollingPath path = PathOf(*best.scene, *best.trajectory);
  const Charted charted(spec, path, ChartOf(*best.scene));
  GaitSolution refined = SolveFromCoarse(charted.spec, *charted.problem, std::move(best), budget);
  refined.scene = charted.spec.scene;
  if (Converged(refined.termination) && !WithinChart(*refined.trajectory)) {
    refined.termination = Termination::kNumericalDifficulty;
    refined.message = "The motion reaches the edge of the chart of its orientation: no optimum of the manoeuvre.";
  }
  return refined;
}

// What is left where no attempt is valid: the best one, and why it is no solution.
GaitSolution Refused(Attempt best, bool had_programs) {
  GaitSolution solution = std::move(best.solution);
  if (!solution.trajectory) {
    if (!had_programs) solution.message = "No chart of the orientation covers the way to the end.";
  } else if (Converged(solution.termination)) {
    solution.termination = Termination::kNumericalDifficulty;
    solution.message =
        best.within_chart
            ? "Only motions that exist on the mesh were found: the body slips between its nodes. Use more "
              "intervals or more time."
            : "Only motions that reach the edge of the chart of their orientation were found.";
  }
  return solution;
}

// Sketches are compared on the mesh of `first`, the best of them is refined to the spec's.
GaitSolution SearchSketches(const GaitSpec& spec, const GaitSpec& first, SolveBudget* budget) {
  const size_t programs = budget->log().size();
  Attempt best = FindBest(first, budget);
  if (best.valid) return Refine(spec, std::move(best.solution), budget);
  return Refused(std::move(best), budget->log().size() > programs);
}

}  // namespace

GaitSolution SolveManoeuvre(const GaitSpec& spec, SolveBudget* budget) {
  const std::optional<GaitSpec> coarse = CoarseStart(spec);
  GaitSolution solution = SearchSketches(spec, coarse ? *coarse : spec, budget);
  if (coarse && !Converged(solution.termination) && budget->Left()) {
    solution = SearchSketches(spec, spec, budget);
  }
  solution.meshes = budget->log();
  solution.wall_time = budget->elapsed();
  return solution;
}

}  // namespace rollgait
