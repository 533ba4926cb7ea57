#include "core/gait/adopt_solution.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/gait/judge_solution.h"
#include "core/gait/power_smoothing.h"

namespace rollgait {
namespace {

std::vector<CostValue> ReportCosts(const OptimalControlProblem& problem, CollocationNlp& nlp, const double* x) {
  const VectorX integrals = nlp.CostIntegrals(x), unsmoothed = nlp.CostIntegrals(x, CostForm::kUnsmoothed);
  std::vector<CostValue> values;
  for (size_t t = 0; t < problem.costs.size(); ++t) {
    const CostDescription& term = problem.costs[t];
    CostValue value;
    value.name = term.name;
    value.unit = term.unit;
    value.weight = term.weight;
    value.value = integrals(static_cast<int>(t));
    value.unsmoothed = unsmoothed(static_cast<int>(t));
    value.contribution = term.weight * value.value / nlp.Denominator(x);
    values.push_back(value);
  }
  return values;
}

// Rows that miss their bounds by more than the tolerance, worst (in natural sizes) first.
std::vector<UnmetConstraint> FindUnmet(CollocationNlp& nlp, const double* x, double tolerance) {
  constexpr size_t kMost = 10;
  VectorX g(nlp.constraints());
  if (!nlp.Constraints(x, g.data())) return {};
  std::vector<std::pair<double, int>> misses;
  for (int r = 0; r < g.size(); ++r) {
    const double miss = std::max(nlp.constraint_lower()(r) - g(r), g(r) - nlp.constraint_upper()(r));
    if (miss > tolerance) misses.emplace_back(miss, r);
  }
  std::sort(misses.rbegin(), misses.rend());
  std::vector<UnmetConstraint> unmet;
  for (size_t i = 0; i < std::min(kMost, misses.size()); ++i) {
    const auto info = nlp.Describe(x, misses[i].second);
    unmet.push_back({info.name, info.phase, info.time, misses[i].first * info.size, info.unit});
  }
  return unmet;
}

}  // namespace

MeshStatistics Describe(const GaitSpec& spec, StartOf start, const CollocationNlp& nlp, const NlpResult& result) {
  MeshStatistics statistics;
  statistics.start = start;
  statistics.slope = spec.slope;
  statistics.kkt_tolerance = spec.kkt_tolerance;
  statistics.cycle = spec.cycle;
  statistics.has_sides_alike = spec.has_sides_alike;
  statistics.has_added_rates = spec.has_added_rates;
  statistics.termination = result.termination;
  statistics.message = result.message;
  statistics.intervals = nlp.mesh().Intervals();
  statistics.unknowns = nlp.variables();
  statistics.constraints = nlp.constraints();
  statistics.jacobian_nonzeros = nlp.jacobian_pattern().size();
  statistics.hessian_nonzeros = nlp.hessian_pattern().size();
  statistics.iterations = result.iterations;
  statistics.wall_time = result.wall_time_s;
  statistics.evaluation_time = result.evaluation_time_s;
  statistics.kkt_error = result.kkt_error;
  statistics.smoothing = LeastSmoothing(spec).value_or(0);
  return statistics;
}

void Adopt(const GaitSpec& spec, const OptimalControlProblem& problem, CollocationNlp& nlp, const NlpResult& result,
           GaitSolution* solution, MeshStatistics* statistics) {
  const double* x = result.x.data();
  solution->objective = result.objective / nlp.objective_scale();
  solution->kkt_error = result.kkt_error;
  solution->constraint_violation = result.constraint_violation;
  solution->trajectory = nlp.Extract(x);
  solution->multipliers = {result.constraint_multipliers / nlp.objective_scale(),
                           (result.lower_bound_multipliers - result.upper_bound_multipliers) / nlp.objective_scale()};
  solution->added = nlp.added();
  solution->costs = ReportCosts(problem, nlp, x);
  solution->unmet_constraints = FindUnmet(nlp, x, 10 * spec.kkt_tolerance);
  solution->speed = nlp.displacement(x) / nlp.duration(x);
  solution->step_length = nlp.displacement(x) / (spec.cycle == Cycle::kFull ? 2 : 1);
  Judge(spec, solution);
  statistics->objective = solution->objective;
  statistics->max_gap = solution->accuracy->max_gap;
  statistics->max_slip = solution->accuracy->max_slip;
}

}  // namespace rollgait
