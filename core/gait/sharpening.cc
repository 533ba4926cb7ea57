#include "core/gait/sharpening.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/gait/build_problem.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/power_smoothing.h"

namespace rollgait {

GaitSolution Sharpen(const GaitSpec& spec, GaitSolution smooth, SolveBudget* budget) {
  constexpr double kFirstStep = 8, kLeastStep = 1.3, kRounding = 1e-9;
  // Where minima follow one another closely 10 to 60 iterations do, in a full cycle up to 103; beyond that a smaller
  // step costs less than patience. bench/success_rate, 18 requests of human29 at standard accuracy: 1664 iterations in
  // all with 120, 1733 with 80; a prosthetic foot (bench/one_sided) 223 and 299.
  constexpr int kMostIterations = 120, kPatience = 300;
  const double least = LeastSmoothing(spec).value();
  double reached = ColdSmoothing(spec), step = kFirstStep;
  GaitSolution last = std::move(smooth);
  while (reached > least) {
    // Where even small steps fail the path of minima ends: on to the spec at once, with patience.
    const bool path_ends = step < kLeastStep;
    const bool arrives = path_ends || reached / step <= (1 + kRounding) * least;
    const double next = arrives ? least : reached / step;
    GaitSpec sharper = SmoothedBy(next, spec);
    if (next > least) LeaveTheRest(&sharper);
    sharper.warm_start = StartFrom(spec, last);
    GaitSolution solution =
        SolveFromSmoother(sharper, *BuildProblem(sharper), last, path_ends ? kPatience : kMostIterations, budget);
    solution.note = last.note;
    solution.warm_started = solution.used_multipliers = false;  // not from what the request named
    PutBefore(last.meshes, &solution);
    if (Converged(solution.termination)) {
      last = std::move(solution);
      reached = next;
      continue;
    }
    if (path_ends || !budget->Left()) {
      std::ostringstream note;
      const double watt = spec.units.mass / std::pow(spec.units.time, 3);
      note << " It converged with powers smoothed by " << watt * reached << " W, not by " << watt * next << " W.";
      solution.message += note.str();
      return solution;
    }
    last.meshes = std::move(solution.meshes);
    step = std::sqrt(step);
  }
  return last;
}

}  // namespace rollgait
