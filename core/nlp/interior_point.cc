#include "core/nlp/interior_point.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/nlp/bound_multipliers.h"
#include "core/nlp/interior_point_solver.h"
#include "core/nlp/step_length.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

// Constants of the algorithm; names as in Wächter and Biegler, values as in Ipopt.
constexpr double kPush = 0.01, kMostMultiplier = 1000;
// Of the violation where restoration began, what a point may have that ends it (Ipopt:
// required_infeasibility_reduction).
constexpr double kKappaResto = 0.9;

}  // namespace

InteriorPointResult InteriorPointSolver::Run() {
  const bool has_begun = resumption_.from != nullptr ? Resume(*resumption_.from) : Begin();
  const Termination termination = has_begun ? Iterate() : Termination::kNumericalDifficulty;
  InteriorPointResult out;
  out.needs_restoration = needs_restoration_;
  Fill(termination, &out.result);
  return out;
}

bool InteriorPointSolver::Begin() {
  const bool warm = start_.constraint_multipliers.size() > 0;
  const bool estimates = !warm && options_.estimate_multipliers;
  const double warm_push = std::min(kPush, options_.warm_push > 0 ? options_.warm_push : parameter_.mu());
  if (!barrier_.MakeInterior(start_.x, warm || estimates ? warm_push : kPush, &point_)) return false;
  gradient_.resize(barrier_.variables());
  multipliers_.y = warm ? start_.constraint_multipliers : VectorX(VectorX::Zero(barrier_.rows()));
  StartBoundMultipliers(barrier_, point_, parameter_.mu(), start_, estimates, &multipliers_);
  if (!barrier_.Gradient(point_, &gradient_)) return false;
  const double most = estimates ? kInfinity : kMostMultiplier;
  if (!warm && !newton_.StartRowMultipliers(point_, gradient_, most, &multipliers_)) return false;
  for (const int row : barrier_.free_rows()) multipliers_.y(row) = 0;
  if (!Linearise()) return false;
  acceptance_.Begin(point_.theta);
  return true;
}

bool InteriorPointSolver::Resume(const InteriorPointState& state) {
  iteration_ = state.iteration;
  before_s_ = state.elapsed_s;
  parameter_.Restore(state.barrier);
  tiny_steps_ = state.tiny_steps;
  asked_ = state.asked;
  barrier_.MoveBounds(state.moved_bounds);
  multipliers_ = state.multipliers;
  acceptance_.Restore(state.acceptance);
  newton_.Restore(state.newton);
  point_.w = state.w;
  point_.c.resize(barrier_.rows());
  gradient_.resize(barrier_.variables());
  return barrier_.Evaluate(&point_) && Linearise();
}

InteriorPointState InteriorPointSolver::State(const Restoration* phase) const {
  InteriorPointState state{iteration_,
                           Elapsed(),
                           point_.w,
                           multipliers_,
                           parameter_.memory(),
                           acceptance_.memory(),
                           newton_.memory(),
                           barrier_.MovedBounds(),
                           tiny_steps_,
                           asked_};
  if (phase != nullptr) {
    state.newton = phase->newton_before();
    state.restoration = phase->State();
  }
  return state;
}

void InteriorPointSolver::KeepState(const Restoration* phase) {
  if (resumption_.keeper == nullptr) return;
  const bool is_stopped = control_.stop != nullptr && control_.stop->requested();
  if (resumption_.keeper->IsDue(iteration_) || is_stopped) resumption_.keeper->Keep(State(phase));
}

bool InteriorPointSolver::Linearise() {
  if (!barrier_.Gradient(point_, &gradient_) ||
      !problem_.Derivatives(point_.w.data(), 1, multipliers_.y.data(), newton_.kkt().jacobian(),
                            newton_.kkt().hessian())) {
    return false;
  }
  lagrangian_.resize(barrier_.unknowns());
  lagrangian_.head(barrier_.variables()) = gradient_;
  AddConstraintGradients(barrier_, newton_.kkt(), multipliers_.y, &lagrangian_);
  return true;
}

Termination InteriorPointSolver::Iterate() {
  const int reported = resumption_.from != nullptr ? iteration_ : -1;
  if (resumption_.from != nullptr && resumption_.from->restoration) {
    error_ = ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, 0);
    if (const auto end = RunRestoration(&*resumption_.from->restoration)) return *end;
    tiny_steps_ = 0;
    ++iteration_;
  }
  for (;; ++iteration_) {
    error_ = ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, 0);
    if (iteration_ > reported) Report();
    has_restored_ = false;
    if (IsWithin(error_, options_.tolerance) || IsNotWorthFinishing()) return Termination::kOptimal;
    KeepState(nullptr);
    if (const auto limit = Limit()) return *limit;
    // While the barrier parameter can still fall, steps that do not move the point improve the multipliers.
    const double mu_before = parameter_.mu();
    ReduceBarrier(tiny_steps_ > 1);
    if (tiny_steps_ > 3 && parameter_.mu() == mu_before) return Termination::kNumericalDifficulty;
    const bool has_step = newton_.Compute(point_, multipliers_, lagrangian_, parameter_.mu(), &step_);
    const Search outcome = has_step ? LineSearch() : Search::kFailed;
    if (outcome == Search::kFailed) {
      if (const auto end = Restore()) return *end;
      tiny_steps_ = 0;
      continue;
    }
    tiny_steps_ = outcome == Search::kTinyStep ? tiny_steps_ + 1 : 0;
    if (parameter_.RaiseWhereStepsAreShort(primal_step_)) acceptance_.ForgetFilter();
    barrier_.KeepDistance(point_.w, parameter_.mu());
    KeepNearCentralPath(barrier_, point_, parameter_.mu(), &multipliers_);
    if (!Linearise()) return Termination::kNumericalDifficulty;
  }
}

std::optional<Termination> InteriorPointSolver::Limit() const {
  if (control_.stop != nullptr && control_.stop->requested()) return Termination::kCancelled;
  if (Elapsed() > options_.max_wall_time_s) return Termination::kTimeLimit;
  if (iteration_ >= options_.max_iterations) return Termination::kIterationLimit;
  return std::nullopt;
}

std::optional<Termination> InteriorPointSolver::Restore() {
  if (HasAcceptableError()) return Termination::kNumericalDifficulty;
  // Where nothing is violated, nothing can be restored.
  if (error_.primal <= options_.tolerance) {
    needs_restoration_ = true;
    return Termination::kNumericalDifficulty;
  }
  acceptance_.Exclude({point_.theta, barrier_.Barrier(point_, parameter_.mu()), 0});
  return RunRestoration(nullptr);
}

std::optional<Termination> InteriorPointSolver::RunRestoration(const RestorationState* from) {
  needs_restoration_ = true;
  const double theta = point_.theta, mu = parameter_.mu();
  Restoration phase(barrier_, newton_, options_);
  std::optional<Termination> limit;
  bool is_known = from != nullptr;  // the iterate has been reported and kept
  Restoration::Watch watch;
  watch.is_acceptable = [&](const Point& point) {
    return point.theta <= kKappaResto * theta &&
           acceptance_.TakesFromAnywhere({point.theta, barrier_.Barrier(point, mu), 0});
  };
  watch.goes_on = [&] {
    if (!std::exchange(is_known, false)) {
      ++iteration_;
      Report(&phase);
      KeepState(&phase);
    }
    limit = Limit();
    return !limit;
  };
  const Restoration::End end =
      from != nullptr ? phase.Resume(point_, *from, watch) : phase.Run(point_, multipliers_, mu, watch);
  if (end == Restoration::End::kFailed) return Termination::kNumericalDifficulty;
  needs_restoration_ = false;
  has_restored_ = true;
  primal_step_ = phase.primal_step();
  dual_step_ = phase.dual_step();
  step_norm_ = phase.step_norm();
  trials_ = phase.trials();
  TakeRestored(phase.point());
  if (!Linearise()) return Termination::kNumericalDifficulty;
  if (end == Restoration::End::kRestored) return std::nullopt;
  error_ = ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, 0);
  return end == Restoration::End::kInfeasible ? Termination::kInfeasible : *limit;
}

// Multipliers as Ipopt has them after restoration: those of the bounds make the step in w that was taken from where it
// began, or are 1 where one is large then; those of the rows are 0.
void InteriorPointSolver::TakeRestored(const Point& restored) {
  MoveBoundMultipliers(barrier_, point_, restored, parameter_.mu(), parameter_.tau(), kMostMultiplier, &multipliers_);
  multipliers_.y.setZero();
  point_ = restored;
  KeepNearCentralPath(barrier_, point_, parameter_.mu(), &multipliers_);
}

bool InteriorPointSolver::IsNotWorthFinishing() {
  if (asked_ || !options_.worth_finishing || !IsWithin(error_, options_.rough_tolerance)) return false;
  asked_ = true;
  rough_ = !options_.worth_finishing(point_.w.head(barrier_.variables()));
  return rough_;
}

bool InteriorPointSolver::HasAcceptableError() const { return error_.scaled <= AcceptableError(options_.tolerance); }

void InteriorPointSolver::ReduceBarrier(bool stuck) {
  const auto error = [this](double mu) {
    return ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, mu).scaled;
  };
  if (parameter_.Reduce(stuck, error)) acceptance_.ForgetFilter();
}

double InteriorPointSolver::Elapsed() const {
  return before_s_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

void InteriorPointSolver::Report(const Restoration* phase) const {
  if (!control_.observer) return;
  IterationInfo info;
  info.index = iteration_;
  info.objective = point_.f;
  info.primal_infeasibility = error_.primal;
  info.dual_infeasibility = error_.dual;
  info.barrier_parameter = parameter_.mu();
  info.step_norm = step_norm_;
  info.regularization = newton_.regularization();
  info.primal_step = primal_step_;
  info.dual_step = dual_step_;
  info.line_search_trials = trials_;
  info.elapsed_s = Elapsed();
  info.mesh = options_.mesh;
  info.x = point_.w.data();
  info.restoration = has_restored_;
  if (phase != nullptr) {
    info.restoration = true;
    info.objective = phase->point().f;
    info.primal_infeasibility = phase->point().c.lpNorm<Eigen::Infinity>();
    info.dual_infeasibility = phase->error().dual;
    info.barrier_parameter = phase->mu();
    info.step_norm = phase->step_norm();
    info.primal_step = phase->primal_step();
    info.dual_step = phase->dual_step();
    info.line_search_trials = phase->trials();
    info.x = phase->point().w.data();
  }
  control_.observer(info);
}

void InteriorPointSolver::Fill(Termination termination, NlpResult* result) const {
  const int n = barrier_.variables();
  result->termination = termination;
  result->rough = rough_;
  result->iterations = iteration_;
  result->wall_time_s = Elapsed();
  if (point_.w.size() > 0) result->x = point_.w.head(n);
  if (multipliers_.lower.size() > 0) {
    result->constraint_multipliers = multipliers_.y;
    result->lower_bound_multipliers = multipliers_.lower.head(n);
    result->upper_bound_multipliers = multipliers_.upper.head(n);
    result->objective = point_.f;
    result->kkt_error = error_.scaled;
    result->constraint_violation = error_.primal;
  }
  if (termination == Termination::kNumericalDifficulty && result->x.size() > 0 && HasAcceptableError()) {
    result->termination = Termination::kAcceptable;
  }
  result->message = Explain(result->termination);
}

InteriorPointResult SolveWithInteriorPoint(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                                           const SolveControl& control, const Resumption& resumption) {
  return InteriorPointSolver(problem, start, options, control, resumption).Run();
}

}  // namespace rollgait
