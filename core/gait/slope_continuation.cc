#include "core/gait/slope_continuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"
#include "core/gait/multistart.h"
#include "core/gait/parameter_continuation.h"

namespace rollgait {
namespace {

GaitSpec AtSlope(const GaitSpec& spec, double slope) {
  GaitSpec other = spec;
  other.slope = slope;
  other.gravity = spec.gravity.norm() * Vector3(-std::sin(slope), 0, -std::cos(slope));
  if (slope != spec.slope) LeaveTheRest(&other);
  return other;
}

}  // namespace

std::optional<GaitSolution> SolveFromLevelGround(const GaitSpec& spec, SolveBudget* budget) {
  constexpr double kFirstStep = 5 * std::numbers::pi / 180;
  const GaitSpec level = AtSlope(spec, 0);
  GaitSolution start = SolveFromStarts(level, *BuildProblem(level), budget);
  if (!Converged(start.termination) || !budget->Left()) return std::nullopt;
  const double direction = spec.slope > 0 ? 1 : -1, steepness = std::abs(spec.slope);
  const ParameterContinuation continuation = {
      .from = 0,
      .to = steepness,
      .first_step = kFirstStep,
      .least_step = kFirstStep / 8,
      .advance = [steepness](double at, double step) { return std::min(steepness, at + step); },
      .shorten = [](double step) { return step / 2; },
      .solve =
          [&](double angle, const GaitSolution& last) {
            const GaitSpec there = AtSlope(spec, direction * angle);
            return SolveOnMeshes(there, *BuildProblem(there), GuessFromTrajectory(*last.trajectory),
                                 RequestedMesh(spec), budget);
          },
  };
  ContinuationEnd end = Follow(continuation, std::move(start), budget);
  if (end.failed) return std::nullopt;
  end.last.note = " Reached by continuation from level ground, where the start converges.";
  return std::move(end.last);
}

}  // namespace rollgait
