#include "core/gait/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/gait/build_problem.h"
#include "core/gait/judge_solution.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"

namespace rollgait {
namespace {

double Share(double difference, double value) {
  return value != 0 ? std::abs(difference / value) : difference == 0 ? 0 : kInfinity;
}

FinerSolution AsFiner(const GaitSolution& solution) {
  return {*solution.trajectory, solution.objective, solution.speed, solution.step_length,
          MeshOf(*solution.trajectory).Intervals()};
}

// With an error that must be reached the finer solution may become the answer, so that it has to keep every bound.
GaitSolution SolveHalved(const GaitSpec& spec, const GaitSolution& solution, SolveBudget* budget) {
  GaitSpec finer = spec;
  if (!spec.max_error) LeaveTheRest(&finer);
  return SolveFromCoarser(finer, *BuildProblem(finer), StartFrom(finer, solution), Halved(MeshOf(*solution.trajectory)),
                          budget);
}

}  // namespace

ErrorEstimate EstimateErrors(const Scene& scene, const GaitSolution& solution, const FinerSolution& finer) {
  constexpr double kFactor = std::numbers::sqrt2;
  const Trajectory& trajectory = *solution.trajectory;
  ErrorEstimate errors;
  errors.objective = kFactor * Share(solution.objective - finer.objective, solution.objective);
  errors.duration = kFactor * std::abs(trajectory.duration - finer.trajectory.duration);
  errors.speed = kFactor * std::abs(solution.speed - finer.speed);
  errors.step_length = kFactor * std::abs(solution.step_length - finer.step_length);
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const double apart = trajectory.phases[p].duration - finer.trajectory.phases[p].duration;
    errors.phase_durations.push_back(kFactor * std::abs(apart));
  }
  errors.motion = CompareMotions(scene, trajectory, finer.trajectory);
  for (QuantityDifference& difference : errors.motion) {
    difference.largest *= kFactor;
    difference.rms *= kFactor;
    difference.peak *= kFactor;
  }
  errors.finer_intervals = finer.intervals;
  return errors;
}

double WorstShareOf(const MaxError& allowed, const ErrorEstimate& errors) {
  const auto largest = [&](MotionQuantity quantity) { return errors.motion[static_cast<int>(quantity)].largest; };
  double worst = 0;
  const auto take = [&](const std::optional<double>& most, double error) {
    if (most) worst = std::max(worst, error / *most);
  };
  take(allowed.objective, errors.objective);
  take(allowed.angle, largest(MotionQuantity::kAngle));
  take(allowed.torque, largest(MotionQuantity::kTorque));
  take(allowed.contact_force, largest(MotionQuantity::kContactForce));
  return worst;
}

GaitSolution SolveForErrors(const GaitSpec& spec, GaitSolution solution, SolveBudget* budget) {
  while (true) {
    solution.finer.reset();
    if (2 * TotalIntervals(MeshOf(*solution.trajectory)) > kMostIntervals) {
      solution.message += " The errors are not estimated: a mesh of half the intervals' length would have more than " +
                          std::to_string(kMostIntervals) + " intervals.";
      return solution;
    }
    if (!budget->Left()) {
      solution.message += " The errors are not estimated: the time or the iterations are used up.";
      return solution;
    }
    const size_t first = budget->log().size();
    GaitSolution halved = SolveHalved(spec, solution, budget);
    budget->MarkForErrors(first, true);
    solution.wall_time = halved.wall_time;
    const bool is_solved = Converged(halved.termination) && halved.trajectory.has_value();
    if (!is_solved) {
      if (halved.termination == Termination::kCancelled) solution.termination = Termination::kCancelled;
      solution.message += " The errors are not estimated: on the finer mesh, " + halved.message;
      return solution;
    }
    solution.finer = AsFiner(halved);
    budget->Offer(spec, solution);
    if (!spec.max_error || WorstShareOf(*spec.max_error, EstimateErrors(spec.scene, solution, *solution.finer)) <= 1) {
      return solution;
    }
    if (solution.within_requested_accuracy() && halved.verdict.kind == Verdict::Kind::kExceeded) {
      solution.message += " A finer mesh brings smaller errors, but does not keep every bound.";
      return solution;
    }
    // The finer solution is the next answer; its programs were no mere estimate.
    budget->MarkForErrors(first, false);
    halved.note = std::move(solution.note);
    halved.warm_started = solution.warm_started;
    halved.used_multipliers = solution.used_multipliers;
    // Without budget its own errors cannot be told any more; those of the coarser one can.
    if (!budget->Left()) return solution;
    solution = std::move(halved);
  }
}

}  // namespace rollgait
