#include "core/gait/smoothing_continuation.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "core/gait/build_problem.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/parameter_continuation.h"
#include "core/gait/power_smoothing.h"

namespace rollgait {
namespace {

// Where minima follow one another closely 10 to 60 iterations do, in a full cycle up to 103; beyond that a smaller step
// costs less than patience. bench/success_rate, 18 requests of human29 at standard accuracy: 1664 iterations in all
// with 120, 1733 with 80; a prosthetic foot (bench/one_sided) 223 and 299.
constexpr int kMostIterations = 120;
// Where even small steps fail the path of minima ends: on to the spec at once, with patience.
constexpr int kPatience = 300;

GaitSolution SolveSmoothed(const GaitSpec& spec, double smoothing, const GaitSolution& last, int most_iterations,
                           SolveBudget* budget) {
  GaitSpec sharper = SmoothedBy(smoothing, spec);
  if (smoothing > LeastSmoothing(spec).value()) LeaveTheRest(&sharper);
  sharper.warm_start = StartFrom(spec, last);
  return SolveFromSmoother(sharper, *BuildProblem(sharper), last, most_iterations, budget);
}

}  // namespace

GaitSolution ReduceSmoothing(const GaitSpec& spec, GaitSolution smooth, SolveBudget* budget) {
  constexpr double kRounding = 1e-9;
  const double least = LeastSmoothing(spec).value();
  const ParameterContinuation continuation = {
      .from = ColdSmoothing(spec),
      .to = least,
      .first_step = 8,  // factors
      .least_step = 1.3,
      .advance = [least](double at, double step) { return at / step <= (1 + kRounding) * least ? least : at / step; },
      .shorten = [](double step) { return std::sqrt(step); },
      .solve = [&](double smoothing,
                   const GaitSolution& last) { return SolveSmoothed(spec, smoothing, last, kMostIterations, budget); },
  };
  ContinuationEnd end = Follow(continuation, std::move(smooth), budget);
  if (!end.failed) return std::move(end.last);
  GaitSolution solution = std::move(*end.failed);
  if (budget->Left()) {
    end.failed_at = least;
    solution = SolveSmoothed(spec, least, end.last, kPatience, budget);
    solution.note = end.last.note;
    if (Converged(solution.termination)) return solution;
  }
  std::ostringstream note;
  const double watt = spec.units.mass / std::pow(spec.units.time, 3);
  note << " It converged with powers smoothed by " << watt * end.reached << " W, not by " << watt * end.failed_at
       << " W.";
  solution.message += note.str();
  return solution;
}

}  // namespace rollgait
