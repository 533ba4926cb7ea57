#include "core/gait/solve_budget.h"

#include <algorithm>

#include "core/nlp/solve_journal.h"
#include "core/nlp/solve_nlp.h"

namespace rollgait {
namespace {

// Observers see the objective of the request, not that of the scaled NLP.
SolveControl Unscaled(const SolveControl& control, double scale) {
  SolveControl unscaled = control;
  if (control.observer) {
    unscaled.observer = [&control, scale](IterationInfo info) {
      info.objective /= scale;
      control.observer(info);
    };
  }
  return unscaled;
}

}  // namespace

SolveBudget::SolveBudget(const GaitSpec& spec, const SolveControl& control, double objective_unit)
    : control_(control),
      begin_(std::chrono::steady_clock::now()),
      objective_unit_(objective_unit),
      max_wall_time_(spec.max_wall_time),
      iterations_left_(spec.max_iterations) {}

double SolveBudget::elapsed() const {
  const double earlier = control_.journal != nullptr ? control_.journal->earlier_s() : 0;
  return earlier + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool SolveBudget::Left() const {
  return iterations_left_ > 0 && elapsed() < max_wall_time_ &&
         (control_.stop == nullptr || !control_.stop->requested());
}

NlpResult SolveBudget::Run(CollocationNlp& nlp, const NlpStart& start, NlpOptions options) {
  options.mesh = programs_++;
  options.max_iterations = std::max(1, std::min(options.max_iterations, iterations_left_));
  options.max_wall_time_s = max_wall_time_ - elapsed();
  const SolveControl unscaled = Unscaled(control_, nlp.objective_scale() / objective_unit_);
  NlpResult result = control_.journal != nullptr ? control_.journal->Solve(nlp, start, options, unscaled)
                                                 : SolveNlp(nlp, start, options, unscaled);
  iterations_left_ -= result.iterations;
  return result;
}

}  // namespace rollgait
