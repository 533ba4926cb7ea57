#include "core/gait/rate_continuation.h"

#include <cmath>
#include <utility>
#include <variant>

#include "core/gait/build_problem.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/parameter_continuation.h"
#include "core/gait/power_smoothing.h"
#include "core/gait/rate_costs.h"
#include "core/gait/solver_settings.h"

namespace rollgait {
namespace {

// s², of the rate's weight beside the torque's, on Earth.
constexpr double kFirstWeight = 1e-4;

double TorqueWeight(const GaitSpec& spec) {
  double weight = 0;
  for (const GaitSpec::CostTerm& cost : spec.costs) {
    if (std::holds_alternative<cost::SquaredTorque>(cost.term)) weight += cost.weight;
  }
  return weight;
}

GaitSpec WithRatesAt(double rate_weight, GaitSpec spec) {
  const double weight = rate_weight * std::pow(spec.similarity.time(), 2) * TorqueWeight(spec);
  GaitSpec::CostTerm& rate = spec.costs.emplace_back();
  rate.term = cost::SquaredTorqueRate{};
  rate.weight = weight;
  spec.has_added_rates = true;
  return spec;
}

GaitSpec AsAStart(GaitSpec spec) {
  spec.kkt_tolerance = ToleranceOfStart(spec);
  spec.is_only_a_start = true;
  return spec;
}

}  // namespace

bool LeavesRatesFree(const GaitSpec& spec) {
  return TorqueWeight(spec) > 0 && !HasRates(spec) && !LeastSmoothing(spec) && HasRatesOfEfforts(spec.scheme);
}

GaitSpec WithRates(const GaitSpec& spec) { return AsAStart(WithRatesAt(kFirstWeight, spec)); }

GaitSolution AddRates(const GaitSpec& spec, const GaitSolution& solution, SolveBudget* budget) {
  GaitSpec rated = WithRates(spec);
  rated.warm_start = StartFrom(spec, solution);
  return SolveFromNeighbour(rated, *BuildProblem(rated), spec.max_iterations, budget);
}

GaitSolution ReleaseRates(const GaitSpec& spec, GaitSolution rated, SolveBudget* budget) {
  constexpr int kMostIterations = 200;
  // human29, slope 20°: from 1e-7 at once to none takes more than 200 iterations, from 1e-10 it takes 27; from 1e-6 to
  // 1e-8 takes 179, by tenths 37.
  constexpr double kStep = 0.1, kLeastWeight = 3e-11;
  const ParameterContinuation continuation = {
      .from = kFirstWeight,
      .to = 0,
      .first_step = kStep,
      .least_step = kStep,
      .advance = [](double weight, double step) { return step * weight < kLeastWeight ? 0 : step * weight; },
      .shorten = [](double) { return 0.0; },
      .solve =
          [&](double weight, const GaitSolution& last) {
            GaitSpec cheaper = weight > 0 ? AsAStart(WithRatesAt(weight, spec)) : spec;
            if (weight > 0) cheaper.max_refinements = 0;
            cheaper.warm_start = StartFrom(spec, last);
            return SolveFromNeighbour(cheaper, *BuildProblem(cheaper), kMostIterations, budget);
          },
  };
  ContinuationEnd end = Follow(continuation, std::move(rated), budget);
  return end.failed ? std::move(*end.failed) : std::move(end.last);
}

}  // namespace rollgait
