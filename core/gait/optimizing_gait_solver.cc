#include "core/gait/optimizing_gait_solver.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/gait/error_estimate.h"
#include "core/gait/gait_search.h"
#include "core/gait/judge_solution.h"
#include "core/gait/newest_solution.h"
#include "core/gait/own_units.h"
#include "core/gait/request_check.h"
#include "core/gait/solve_manoeuvre.h"

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

GaitSolution SearchWithErrors(const GaitSpec& spec, SolveBudget* budget) {
  GaitSolution solution = SearchGait(spec, budget);
  budget->TellLimit(&solution);
  return spec.estimate_errors && Converged(solution.termination) ? SolveForErrors(spec, std::move(solution), budget)
                                                                 : solution;
}

GaitSolution SearchInUnits(const Units& units, const GaitSpec& spec, SolutionSink* sink, SolveBudget* budget) {
  const GaitSpec own = WithoutRounding(InUnits(units, spec));
  NewestSolution newest(spec, own, units, sink);
  budget->OfferTo(&newest);
  GaitSolution solution = SearchWithErrors(own, budget);
  solution.meshes = budget->log();
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
  if (spec.manoeuvre) {
    GaitSolution solution = SolveManoeuvre(spec, &budget);
    budget.TellLimit(&solution);
    return solution;
  }
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
