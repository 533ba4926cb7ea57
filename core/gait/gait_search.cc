#include "core/gait/gait_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/gait/artefact.h"
#include "core/gait/build_problem.h"
#include "core/gait/half_cycle.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_continuation.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"
#include "core/gait/multistart.h"
#include "core/gait/one_sided_start.h"
#include "core/gait/power_smoothing.h"
#include "core/gait/rate_continuation.h"
#include "core/gait/request_check.h"
#include "core/gait/slope_continuation.h"
#include "core/gait/smoothing_continuation.h"
#include "core/gait/solver_settings.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

// What follows on a slope where the starts do not converge: nothing, or continuation from level ground.
enum class Otherwise { kGiveUp, kContinue };

// From the requested starts, and on a slope that these do not reach by continuation.
GaitSolution SearchFromColdStart(const GaitSpec& spec, Otherwise otherwise, SolveBudget* budget) {
  const auto problem = BuildProblem(spec);
  GaitSolution solution =
      spec.starts > 1 ? SolveFromStarts(spec, *problem, budget)
                      : SolveOnMeshes(spec, *problem, WalkingGuess(spec, *problem), RequestedMesh(spec), budget);
  if (Converged(solution.termination) || otherwise == Otherwise::kGiveUp || spec.slope == 0 || !budget->Left()) {
    return solution;
  }
  std::optional<GaitSolution> continued = SolveFromLevelGround(spec, budget);
  return continued ? std::move(*continued) : std::move(solution);
}

// With twice the intervals, where the request leaves the mesh to its accuracy.
GaitSpec WithFinerMesh(GaitSpec spec, int refinements) {
  if (refinements == 0) return spec;
  for (GaitSpec::Phase& phase : spec.phases) phase.intervals *= 2;
  return spec;
}

// Whether powers cost with a sharper corner than a cold start takes.
bool NeedsSmoothing(const GaitSpec& spec) {
  const double cold = ColdSmoothing(spec);
  return LeastSmoothing(spec).value_or(cold) < cold;
}

// The spec as a start for itself: with smooth powers where it needs them.
GaitSpec AsStart(const GaitSpec& spec) {
  GaitSpec start = spec;
  if (NeedsSmoothing(spec)) {
    start = SmoothedBy(ColdSmoothing(spec), spec);
    start.max_iterations = std::min(spec.max_iterations, MostIterations::kFromGuess);
  }
  LeaveTheRest(&start);
  start.kkt_tolerance = ToleranceOfStart(spec);
  return start;
}

// The first mesh with smooth powers, then the spec's. Where that mesh finds an artefact, finer ones with smooth powers.
GaitSolution SearchOnMesh(const GaitSpec& spec, Otherwise otherwise, SolveBudget* budget) {
  if (!NeedsSmoothing(spec)) return SearchFromColdStart(spec, otherwise, budget);
  GaitSpec smooth = AsStart(spec);
  GaitSolution solution = SearchFromColdStart(smooth, otherwise, budget);
  const bool takes_long = solution.termination == Termination::kIterationLimit;
  if ((takes_long || solution.termination == Termination::kNumericalDifficulty) && spec.max_refinements > 0 &&
      budget->Left()) {
    if (takes_long) smooth = WithFinerMesh(std::move(smooth), spec.max_refinements);
    smooth.max_refinements = spec.max_refinements;
    smooth.is_only_a_start = false;
    solution = SearchFromColdStart(smooth, otherwise, budget);
  }
  if (!Converged(solution.termination)) return solution;
  return ReduceSmoothing(spec, std::move(solution), budget);
}

// By way of coarser meshes where the requested one is fine, and without them where that fails.
GaitSolution SearchByMeshes(const GaitSpec& spec, Otherwise otherwise, SolveBudget* budget) {
  const std::optional<GaitSpec> coarse = CoarseStart(spec);
  if (!coarse) return SearchOnMesh(spec, otherwise, budget);
  GaitSolution solution = SolveFromCoarse(spec, *BuildProblem(spec), SearchOnMesh(*coarse, otherwise, budget), budget);
  if ((Converged(solution.termination) && !IsArtefact(spec, solution)) || !budget->Left()) return solution;
  return SearchOnMesh(spec, otherwise, budget);
}

// Whether a solution is all that was asked for.
bool Answers(const GaitSolution& solution) {
  return Converged(solution.termination) && solution.verdict.kind != Verdict::Kind::kExceeded;
}

// Squared torque alone is solved as it is, and where that takes long or leads to motions that exist on no finer mesh,
// by continuation in the weight of torque rates.
GaitSolution SearchWithoutRates(const GaitSpec& spec, SolveBudget* budget) {
  GaitSpec impatient = spec;
  impatient.max_iterations = std::min(spec.max_iterations, MostIterations::kWithoutRates);
  GaitSolution direct = SearchByMeshes(impatient, Otherwise::kGiveUp, budget);
  if (Answers(direct) || !budget->Left()) return direct;
  GaitSolution rated =
      Converged(direct.termination) && !IsArtefact(spec, direct)
          ? AddRates(spec, direct, budget)
          : SearchOnMesh(WithFinerMesh(WithRates(spec), spec.max_refinements), Otherwise::kGiveUp, budget);
  if (!Converged(rated.termination)) return direct;
  GaitSolution solution = ReleaseRates(spec, std::move(rated), budget);
  return Converged(solution.termination) ? std::move(solution) : std::move(direct);
}

GaitSolution SearchCold(const GaitSpec& spec, SolveBudget* budget);

// What a search returns whose limit was reached before any program of the spec itself was solved.
GaitSolution WithoutAnyProgram(const SolveBudget& budget) {
  GaitSolution solution;
  solution.termination = budget.Cut().value_or(Termination::kIterationLimit);
  solution.message = Explain(solution.termination);
  solution.wall_time = budget.elapsed();
  return solution;
}

// One step first, where the second may be its mirror image. Empty where that does not answer and the search goes on.
std::optional<GaitSolution> SearchByHalves(const GaitSpec& spec, SolveBudget* budget) {
  const std::optional<GaitSpec> half = HalfCycleOf(spec);
  if (!half) return std::nullopt;
  const GaitSolution step = SearchCold(*half, budget);
  if (!Answers(step)) return std::nullopt;
  GaitSpec both = spec;
  both.warm_start = BothSteps(spec, step);
  const auto problem = BuildProblem(both);
  GaitSolution solution = SolveFromImage(both, *problem, MostIterations::kFromImage, budget);
  if (!Answers(solution) && budget->Left()) {
    // A symmetric gait may be a saddle point of the full cycle: unequal steps are cheaper, and the solver leaves the
    // image, which lies too close to its bounds to go anywhere from.
    solution = SolveFromNeighbour(both, *problem, MostIterations::kFromWarmStart, budget);
  }
  if (!Answers(solution) && budget->Left()) return std::nullopt;
  solution.note = step.note;
  return solution;
}

// From a step of the body whose sides are alike, and its mirror image; with smooth powers first, where powers cost.
// Where the request asks for several starts the guesses are tried as well, and the cheaper gait is taken. Empty where
// none answers and the search goes on.
std::optional<GaitSolution> SearchFromSymmetric(const GaitSpec& spec, SolveBudget* budget) {
  // With both sides alike the body walks the cheaper, so another start saves about what the difference of the sides
  // costs at most. Above a tenth it may be worth a word.
  constexpr double kDear = 1.1;
  const std::optional<GaitSpec> step_spec = SymmetricStepOf(spec);
  if (!step_spec) return std::nullopt;
  const GaitSolution step = SearchCold(AsStart(*step_spec), budget);
  if (!Converged(step.termination) || !budget->Left()) return std::nullopt;
  const GaitSpec first = NeedsSmoothing(spec) ? AsStart(spec) : spec;
  GaitSpec from_step = first;
  from_step.warm_start = OneSidedStart(spec, step);
  GaitSolution solution =
      SolveFromNeighbour(from_step, *BuildProblem(from_step), MostIterations::kFromSymmetric, budget);
  if (!Converged(solution.termination)) {
    if (!budget->Left()) return solution;
    return std::nullopt;
  }
  solution.note += " It was started from the gait of the body with both sides alike.";
  if (spec.starts == 1 && solution.objective > kDear * step.objective) {
    const double hundredths = std::round(100 * solution.objective / step.objective);
    solution.note += " It costs " + FormatNumber(hundredths / 100) +
                     " times as much as with both sides alike; with 2 or more `starts` there may be a cheaper one.";
  }
  std::vector<GaitSolution> candidates;
  candidates.push_back(std::move(solution));
  if (spec.starts > 1 && budget->Left()) {
    GaitSolution other = SearchFromColdStart(first, Otherwise::kGiveUp, budget);
    if (Converged(other.termination)) {
      const bool is_cheaper = other.objective < candidates.front().objective;
      other.note += " It was started from a guess, not from the gait of the body with both sides alike.";
      candidates.insert(is_cheaper ? candidates.begin() : candidates.end(), std::move(other));
    }
  }
  for (GaitSolution& candidate : candidates) {
    if (NeedsSmoothing(spec)) candidate = ReduceSmoothing(spec, std::move(candidate), budget);
    if (Answers(candidate) || !budget->Left()) return std::move(candidate);
  }
  return std::nullopt;
}

GaitSolution SearchCold(const GaitSpec& spec, SolveBudget* budget) {
  std::optional<GaitSolution> solution = SearchByHalves(spec, budget);
  if (!solution && budget->Left()) solution = SearchFromSymmetric(spec, budget);
  if (solution) return std::move(*solution);
  if (!budget->Left()) return WithoutAnyProgram(*budget);
  return LeavesRatesFree(spec) ? SearchWithoutRates(spec, budget) : SearchByMeshes(spec, Otherwise::kContinue, budget);
}

}  // namespace

GaitSolution SearchGait(const GaitSpec& spec, SolveBudget* budget) {
  if (!spec.warm_start) return SearchCold(spec, budget);
  GaitSolution warm = SolveFromWarmStart(spec, *BuildProblem(spec), MostIterations::kFromWarmStart, budget);
  if (Converged(warm.termination) || !budget->Left()) return warm;
  GaitSolution cold = SearchCold(spec, budget);
  cold.note += " Started afresh, since the warm start did not converge (" + warm.message + ")";
  return cold;
}

}  // namespace rollgait
