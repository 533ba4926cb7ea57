#include "core/gait/solve_budget.h"

#include <algorithm>

#include "core/gait/iterate_sink.h"
#include "core/gait/newest_solution.h"
#include "core/nlp/solve_journal.h"
#include "core/nlp/solve_nlp.h"
#include "core/nlp/termination.h"

namespace rollgait {

SolveBudget::SolveBudget(const GaitSpec& spec, const SolveControl& control, const Units& units)
    : control_(control),
      begin_(std::chrono::steady_clock::now()),
      units_(units),
      shows_iterates_(control.iterates != nullptr && !spec.manoeuvre),
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

std::optional<Termination> SolveBudget::Cut() const {
  if (control_.stop != nullptr && control_.stop->requested()) return Termination::kCancelled;
  if (elapsed() >= max_wall_time_) return Termination::kTimeLimit;
  return std::nullopt;
}

void SolveBudget::TellLimit(GaitSolution* solution) const {
  const bool failed =
      solution->termination == Termination::kInfeasible || solution->termination == Termination::kNumericalDifficulty;
  if (!failed || Left()) return;
  solution->termination = Cut().value_or(Termination::kIterationLimit);
  solution->message = Explain(solution->termination) + " The last program before it: " + solution->message;
}

void SolveBudget::MarkForErrors(size_t first, bool for_errors) {
  for (size_t i = first; i < log_.size(); ++i) log_[i].for_errors = for_errors;
}

void SolveBudget::Offer(const GaitSpec& spec, GaitSolution solution) const {
  if (newest_ == nullptr) return;
  solution.meshes = log_;
  newest_->Offer(spec, solution, elapsed());
}

SolveControl SolveBudget::ControlOf(const CollocationNlp& nlp, double scale) const {
  SolveControl control = control_;
  if (!control_.observer && !shows_iterates_) return control;
  control.observer = [this, &nlp, scale](IterationInfo info) {
    info.objective /= scale;
    if (control_.observer) control_.observer(info);
    if (shows_iterates_ && info.x != nullptr && control_.iterates->Wants()) Show(info, nlp);
  };
  return control;
}

void SolveBudget::Show(const IterationInfo& iteration, const CollocationNlp& nlp) const {
  // Enough for the eye, and at most 128 in all: rollgait.v1.Iterate promises it.
  constexpr int kMostOfAPhase = 16, kMostInAll = 128;
  const int phases = nlp.layout().phases();
  CoarseMotion motion = nlp.ExtractCoarse(iteration.x, std::clamp(kMostInAll / phases, 2, kMostOfAPhase));
  motion.duration *= units_.time;
  for (CoarseMotion::Phase& phase : motion.phases) {
    phase.start *= units_.time;
    phase.duration *= units_.time;
    for (double& time : phase.times) time *= units_.time;
  }
  control_.iterates->Take(iteration, motion);
}

NlpResult SolveBudget::Run(CollocationNlp& nlp, const NlpStart& start, NlpOptions options) {
  options.mesh = static_cast<int>(log_.size());
  options.max_iterations = std::min(options.max_iterations, iterations_left_);
  options.max_wall_time_s = max_wall_time_ - elapsed();
  const SolveControl control = ControlOf(nlp, nlp.objective_scale() / units_.objective);
  NlpResult result = control_.journal != nullptr ? control_.journal->Solve(nlp, start, options, control)
                                                 : SolveNlp(nlp, start, options, control);
  iterations_left_ -= result.iterations;
  return result;
}

}  // namespace rollgait
