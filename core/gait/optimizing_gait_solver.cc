#include "core/gait/optimizing_gait_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/gait/artefact.h"
#include "core/gait/build_problem.h"
#include "core/gait/error_estimate.h"
#include "core/gait/half_cycle.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_ascent.h"
#include "core/gait/meshes.h"
#include "core/gait/newest_solution.h"
#include "core/gait/one_sided_start.h"
#include "core/gait/own_units.h"
#include "core/gait/power_smoothing.h"
#include "core/gait/rate_continuation.h"
#include "core/gait/request_check.h"
#include "core/gait/sharpening.h"
#include "core/gait/solve_manoeuvre.h"
#include "core/gait/solver_settings.h"
#include "core/gait/walking_search.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

// A gait that is periodic leaves its momentum as it was: over a cycle the ground's mean force is the weight, which on a
// slope leans by the slope. Within the friction cone at every instant, the mean is within it too. So it is for a
// manoeuvre from rest to rest.
std::optional<UnmetConstraint> FindContradiction(const GaitSpec& spec) {
  if (spec.manoeuvre) {
    const Manoeuvre& manoeuvre = *spec.manoeuvre;
    if (!manoeuvre.start.angular_velocity.isZero(0) || !manoeuvre.end.angular_velocity.isZero(0)) return std::nullopt;
  }
  const double needed = std::hypot(spec.gravity.x(), spec.gravity.y()) / std::abs(spec.gravity.z());
  if (needed <= spec.friction_coefficient) return std::nullopt;
  return UnmetConstraint{"friction on average", 0, 0, needed - spec.friction_coefficient, "1"};
}

// What follows on a slope where the starts do not converge: nothing, or continuation from level ground.
enum class Otherwise { kGiveUp, kContinue };

// From the requested starts, and on a slope that these do not reach by continuation.
GaitSolution SearchFromAfar(const GaitSpec& spec, Otherwise otherwise, SolveBudget* budget) {
  const auto problem = BuildProblem(spec);
  GaitSolution solution =
      spec.starts > 1 ? SolveFromStarts(spec, *problem, budget)
                      : SolveOnMeshes(spec, *problem, WalkingGuess(spec, *problem), RequestedMesh(spec), budget);
  if (Converged(solution.termination) || otherwise == Otherwise::kGiveUp || spec.slope == 0 || !budget->Left()) {
    return solution;
  }
  std::vector<MeshStatistics> meshes = std::move(solution.meshes);
  std::optional<GaitSolution> continued = SolveByContinuation(spec, budget, &meshes);
  if (continued) solution = std::move(*continued);
  solution.meshes = std::move(meshes);
  return solution;
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
  if (!NeedsSmoothing(spec)) return SearchFromAfar(spec, otherwise, budget);
  GaitSpec smooth = AsStart(spec);
  GaitSolution solution = SearchFromAfar(smooth, otherwise, budget);
  const bool takes_long = solution.termination == Termination::kIterationLimit;
  if ((takes_long || solution.termination == Termination::kNumericalDifficulty) && spec.max_refinements > 0 &&
      budget->Left()) {
    if (takes_long) smooth = WithFinerMesh(std::move(smooth), spec.max_refinements);
    smooth.max_refinements = spec.max_refinements;
    smooth.is_only_a_start = false;
    GaitSolution refined = SearchFromAfar(smooth, otherwise, budget);
    PutBefore(solution.meshes, &refined);
    solution = std::move(refined);
  }
  if (!Converged(solution.termination)) return solution;
  return Sharpen(spec, std::move(solution), budget);
}

// By way of coarser meshes where the requested one is fine, and without them where that fails.
GaitSolution SearchByMeshes(const GaitSpec& spec, Otherwise otherwise, SolveBudget* budget) {
  const std::optional<GaitSpec> coarse = CoarseStart(spec);
  if (!coarse) return SearchOnMesh(spec, otherwise, budget);
  GaitSolution ascended = Ascend(spec, *BuildProblem(spec), SearchOnMesh(*coarse, otherwise, budget), budget);
  if ((Converged(ascended.termination) && !IsArtefact(spec, ascended)) || !budget->Left()) return ascended;
  GaitSolution solution = SearchOnMesh(spec, otherwise, budget);
  PutBefore(ascended.meshes, &solution);
  return solution;
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
  PutBefore(direct.meshes, &rated);
  direct.meshes = rated.meshes;
  if (!Converged(rated.termination)) return direct;
  GaitSolution solution = ReleaseRates(spec, std::move(rated), budget);
  if (Converged(solution.termination)) return solution;
  direct.meshes = std::move(solution.meshes);
  return direct;
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

// One step first, where the second may be its mirror image. Empty where that does not answer and the search goes on;
// `meshes` receives those that came before the solution.
std::optional<GaitSolution> SearchByHalves(const GaitSpec& spec, SolveBudget* budget,
                                           std::vector<MeshStatistics>* meshes) {
  const std::optional<GaitSpec> half = HalfCycleOf(spec);
  if (!half) return std::nullopt;
  GaitSolution step = SearchCold(*half, budget);
  meshes->insert(meshes->end(), step.meshes.begin(), step.meshes.end());
  if (!Answers(step)) return std::nullopt;
  GaitSpec both = spec;
  both.warm_start = BothSteps(spec, step);
  const auto problem = BuildProblem(both);
  GaitSolution solution = SolveFromImage(both, *problem, MostIterations::kFromImage, budget);
  if (!Answers(solution) && budget->Left()) {
    // A symmetric gait may be a saddle point of the full cycle: unequal steps are cheaper, and the solver leaves the
    // image, which lies too close to its bounds to go anywhere from.
    meshes->insert(meshes->end(), solution.meshes.begin(), solution.meshes.end());
    solution = SolveFromNeighbour(both, *problem, MostIterations::kFromWarmStart, budget);
  }
  if (!Answers(solution) && budget->Left()) {
    meshes->insert(meshes->end(), solution.meshes.begin(), solution.meshes.end());
    return std::nullopt;
  }
  solution.warm_started = solution.used_multipliers = false;  // not from what the request named
  solution.note = step.note;
  return solution;
}

// From a step of the body whose sides are alike, and its mirror image; with smooth powers first, where powers cost.
// Where the request asks for several starts the guesses are tried as well, and the cheaper gait is taken. Empty where
// none answers and the search goes on; `meshes` as above.
std::optional<GaitSolution> SearchFromSymmetric(const GaitSpec& spec, SolveBudget* budget,
                                                std::vector<MeshStatistics>* meshes) {
  // With both sides alike the body walks the cheaper, so another start saves about what the difference of the sides
  // costs at most. Above a tenth it may be worth a word.
  constexpr double kDear = 1.1;
  const std::optional<GaitSpec> step_spec = SymmetricStepOf(spec);
  if (!step_spec) return std::nullopt;
  const auto keep_meshes = [meshes](GaitSolution* of) {
    meshes->insert(meshes->end(), of->meshes.begin(), of->meshes.end());
    of->meshes.clear();
  };
  GaitSolution step = SearchCold(AsStart(*step_spec), budget);
  keep_meshes(&step);
  if (!Converged(step.termination) || !budget->Left()) return std::nullopt;
  const GaitSpec first = NeedsSmoothing(spec) ? AsStart(spec) : spec;
  GaitSpec from_step = first;
  from_step.warm_start = OneSidedStart(spec, step);
  GaitSolution solution =
      SolveFromNeighbour(from_step, *BuildProblem(from_step), MostIterations::kFromSymmetric, budget);
  solution.warm_started = solution.used_multipliers = false;  // not from what the request named
  if (!Converged(solution.termination)) {
    if (!budget->Left()) return solution;
    keep_meshes(&solution);
    return std::nullopt;
  }
  solution.note += " It was started from the gait of the body with both sides alike.";
  if (spec.starts == 1 && solution.objective > kDear * step.objective) {
    solution.note += " It costs " + FormatNumber(solution.objective / step.objective) +
                     " times as much as with both sides alike; with 2 or more `starts` there may be a cheaper one.";
  }
  std::vector<GaitSolution> candidates;
  candidates.push_back(std::move(solution));
  if (spec.starts > 1 && budget->Left()) {
    keep_meshes(&candidates.front());
    GaitSolution other = SearchFromAfar(first, Otherwise::kGiveUp, budget);
    keep_meshes(&other);
    if (Converged(other.termination)) {
      const bool is_cheaper = other.objective < candidates.front().objective;
      other.note += " It was started from a guess, not from the gait of the body with both sides alike.";
      candidates.insert(is_cheaper ? candidates.begin() : candidates.end(), std::move(other));
    }
  }
  for (GaitSolution& candidate : candidates) {
    if (NeedsSmoothing(spec)) candidate = Sharpen(spec, std::move(candidate), budget);
    if (Answers(candidate) || !budget->Left()) return std::move(candidate);
    keep_meshes(&candidate);
  }
  return std::nullopt;
}

GaitSolution SearchCold(const GaitSpec& spec, SolveBudget* budget) {
  std::vector<MeshStatistics> meshes;
  std::optional<GaitSolution> solution = SearchByHalves(spec, budget, &meshes);
  if (!solution && budget->Left()) solution = SearchFromSymmetric(spec, budget, &meshes);
  if (!solution && !budget->Left()) solution = WithoutAnyProgram(*budget);
  if (!solution) {
    solution =
        LeavesRatesFree(spec) ? SearchWithoutRates(spec, budget) : SearchByMeshes(spec, Otherwise::kContinue, budget);
  }
  PutBefore(meshes, &*solution);
  return std::move(*solution);
}

// From the warm start, if there is one, and without it where that does not converge.
GaitSolution Search(const GaitSpec& spec, SolveBudget* budget) {
  if (!spec.warm_start) return SearchCold(spec, budget);
  GaitSolution warm = SolveFromWarmStart(spec, *BuildProblem(spec), MostIterations::kFromWarmStart, budget);
  if (Converged(warm.termination) || !budget->Left()) return warm;
  GaitSolution cold = SearchCold(spec, budget);
  PutBefore(warm.meshes, &cold);
  cold.note += " Started afresh, since the warm start did not converge (" + warm.message + ")";
  return cold;
}

GaitSolution SearchWithErrors(const GaitSpec& spec, SolveBudget* budget) {
  GaitSolution solution = Search(spec, budget);
  return spec.estimate_errors && Converged(solution.termination) ? SolveForErrors(spec, std::move(solution), budget)
                                                                 : solution;
}

GaitSolution SearchInUnits(const Units& units, const GaitSpec& spec, SolutionSink* sink, SolveBudget* budget) {
  const GaitSpec own = WithoutRounding(InUnits(units, spec));
  NewestSolution newest(spec, own, units, sink);
  budget->OfferTo(&newest);
  GaitSolution solution = SearchWithErrors(own, budget);
  budget->OfferTo(nullptr);
  const std::optional<Termination> cut = budget->Cut();
  return cut ? InSiWhenCut(spec, own, units, std::move(solution), *cut, newest.solution())
             : InSi(units, spec, std::move(solution));
}

// The comparison of each leg with normative data where the two differ, else of the right one.
void CompareLegs(const GaitSpec& spec, GaitSolution* solution) {
  solution->normative = CompareWithPeople(spec.scene, *solution->trajectory, *solution->events);
  if (spec.scene.symmetric) return;
  const auto from_left = MeasureGaitEvents(spec.scene, *solution->trajectory, spec.gravity, Foot::kLeft);
  if (!from_left) return;
  solution->normative_left = CompareWithPeople(spec.scene, *solution->trajectory, *from_left, Foot::kLeft);
}

}  // namespace

GaitSolution OptimizingGaitSolver::Solve(const GaitSpec& spec, const SolveControl& control) {
  const Units units = spec.manoeuvre ? Units{} : OwnUnits(spec);
  SolveBudget budget(spec, control, units);
  if (const auto contradiction = FindContradiction(spec)) {
    GaitSolution solution;
    solution.termination = Termination::kInfeasible;
    solution.message =
        "No motion can meet the request: to carry the weight without sliding, the ground must provide a friction "
        "coefficient of at least " +
        FormatNumber(spec.friction_coefficient + contradiction->violation) + "; it provides " +
        FormatNumber(spec.friction_coefficient) + ".";
    solution.unmet_constraints = {*contradiction};
    return solution;
  }
  if (spec.manoeuvre) return SolveManoeuvre(spec, &budget);
  GaitSolution solution = SearchInUnits(units, spec, control.solutions, &budget);
  if (solution.finer) {
    solution.errors = EstimateErrors(spec.scene, solution, *solution.finer);
    if (spec.max_error) {
      const double worst = WorstShareOf(*spec.max_error, *solution.errors);
      solution.errors->is_within_max_error = worst <= 1;
      if (worst > 1)
        solution.message +=
            " The error that was asked for is not reached; the largest is " + FormatNumber(worst) + " times it.";
    }
  }
  solution.message += solution.note;
  if (spec.is_full_by_body) solution.message += " Left and right of the body differ, so this is a full cycle.";
  if (solution.trajectory) solution.events = MeasureGaitEvents(spec.scene, *solution.trajectory, spec.gravity);
  if (solution.events) CompareLegs(spec, &solution);
  return solution;
}

}  // namespace rollgait
