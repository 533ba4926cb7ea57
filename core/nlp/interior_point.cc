#include "core/nlp/interior_point.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/bound_multipliers.h"
#include "core/nlp/newton_step.h"
#include "core/nlp/optimality.h"
#include "core/nlp/step_acceptance.h"
#include "core/nlp/step_length.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

using Clock = std::chrono::steady_clock;
using Point = BarrierProblem::Point;

// Constants of the algorithm; names as in Wächter and Biegler, values as in Ipopt.
constexpr double kKappaSoc = 0.99, kPush = 0.01, kMostMultiplier = 1000;
constexpr int kMostCorrections = 4;
// Of recentred steps: shorter ones are worth it; how much longer they are to be, and the part of that which is enough.
constexpr double kLongStep = 0.9, kLengthening = 0.6, kLeastGain = 0.1;
// Share of the optimality error that a step past the filter may leave.
constexpr double kWorthwhile = 0.9;

class Solver {
 public:
  Solver(NlpProblem& problem, const NlpStart& start, const NlpOptions& options, const SolveControl& control,
         const Resumption& resumption)
      : problem_(problem),
        start_(start),
        options_(options),
        control_(control),
        resumption_(resumption),
        barrier_(problem, options.BoundRelaxation()),
        newton_(barrier_, options),
        parameter_(options),
        begin_(Clock::now()) {}

  InteriorPointResult Run() {
    const bool has_begun = resumption_.from != nullptr ? Resume(*resumption_.from) : Begin();
    const Termination termination = has_begun ? Iterate() : Termination::kNumericalDifficulty;
    InteriorPointResult out;
    out.needs_restoration = needs_restoration_;
    Fill(termination, &out.result);
    return out;
  }

 private:
  enum class Search { kStep, kTinyStep, kFailed };

  bool Begin() {
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

  bool Resume(const InteriorPointState& state) {
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

  InteriorPointState State() const {
    return {iteration_,
            Elapsed(),
            point_.w,
            multipliers_,
            parameter_.memory(),
            acceptance_.memory(),
            newton_.memory(),
            barrier_.MovedBounds(),
            tiny_steps_,
            asked_};
  }

  bool Linearise() {
    if (!barrier_.Gradient(point_, &gradient_) ||
        !problem_.Derivatives(point_.w.data(), 1, multipliers_.y.data(), newton_.kkt().jacobian(),
                              newton_.kkt().hessian())) {
      return false;
    }
    lagrangian_ = gradient_;
    AddConstraintGradients(barrier_, newton_.kkt(), multipliers_.y, &lagrangian_);
    return true;
  }

  Termination Iterate() {
    const int reported = resumption_.from != nullptr ? iteration_ : -1;
    for (;; ++iteration_) {
      error_ = ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, 0);
      if (iteration_ > reported) Report();
      if (IsWithin(error_, options_.tolerance) || IsNotWorthFinishing()) return Termination::kOptimal;
      const bool is_stopped = control_.stop != nullptr && control_.stop->requested();
      if (resumption_.keeper != nullptr && (resumption_.keeper->IsDue(iteration_) || is_stopped)) {
        resumption_.keeper->Keep(State());
      }
      if (is_stopped) return Termination::kCancelled;
      if (Elapsed() > options_.max_wall_time_s) return Termination::kTimeLimit;
      if (iteration_ >= options_.max_iterations) return Termination::kIterationLimit;
      // While the barrier parameter can still fall, steps that do not move the point improve the multipliers.
      const double mu_before = parameter_.mu();
      ReduceBarrier(tiny_steps_ > 1);
      if (tiny_steps_ > 3 && parameter_.mu() == mu_before) return Termination::kNumericalDifficulty;
      if (!newton_.Compute(point_, multipliers_, lagrangian_, parameter_.mu(), &step_)) {
        needs_restoration_ = !HasAcceptableError();
        return Termination::kNumericalDifficulty;
      }
      const Search outcome = LineSearch();
      if (outcome == Search::kFailed) {
        needs_restoration_ = !HasAcceptableError();
        return Termination::kNumericalDifficulty;
      }
      tiny_steps_ = outcome == Search::kTinyStep ? tiny_steps_ + 1 : 0;
      if (parameter_.RaiseWhereStepsAreShort(primal_step_)) acceptance_.ForgetFilter();
      barrier_.KeepDistance(point_.w, parameter_.mu());
      KeepNearCentralPath(barrier_, point_, parameter_.mu(), &multipliers_);
      if (!Linearise()) return Termination::kNumericalDifficulty;
    }
  }

  bool IsNotWorthFinishing() {
    if (asked_ || !options_.worth_finishing || !IsWithin(error_, options_.rough_tolerance)) return false;
    asked_ = true;
    rough_ = !options_.worth_finishing(point_.w.head(barrier_.variables()));
    return rough_;
  }

  bool HasAcceptableError() const { return error_.scaled <= AcceptableError(options_.tolerance); }

  void ReduceBarrier(bool stuck) {
    const auto error = [this](double mu) {
      return ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, mu).scaled;
    };
    if (parameter_.Reduce(stuck, error)) acceptance_.ForgetFilter();
  }

  Search LineSearch() {
    objective_gradient_.setZero(barrier_.unknowns());
    objective_gradient_.head(barrier_.variables()) = gradient_;
    barrier_.AddBarrierGradient(point_, parameter_.mu(), objective_gradient_, &barrier_gradient_);
    from_ = {point_.theta, barrier_.Barrier(point_, parameter_.mu()), barrier_gradient_.dot(step_.w)};
    double alpha = MaxPrimalStep(barrier_, point_, step_.w, parameter_.tau());
    dual_step_ = MaxDualStep(multipliers_, step_.multipliers, parameter_.tau());
    trials_ = 0;
    if (IsTiny(step_.w, point_)) {
      if (!Try(alpha, step_.w)) return Search::kFailed;
      Accept(alpha, step_);
      return Search::kTinyStep;
    }
    if (options_.recentre && std::min(alpha, dual_step_) < kLongStep && TryRecentred(alpha)) return Search::kStep;
    const double least = acceptance_.SmallestStep(from_);
    for (bool first = true; first || alpha > least; first = false, alpha *= 0.5) {
      ++trials_;
      const bool valid = Try(alpha, step_.w);
      if (valid && IsAcceptable(alpha)) {
        Accept(alpha, step_);
        return Search::kStep;
      }
      if (first && valid && trial_.theta >= point_.theta && SecondOrderCorrection(alpha)) return Search::kStep;
    }
    return TryForOptimality() ? Search::kStep : Search::kFailed;
  }

  // The whole Newton step for what it does to the optimality conditions, whatever the filter says of it: close to a
  // solution the filter compares roundings (Wächter and Biegler, section 3.3, before the restoration phase).
  bool TryForOptimality() {
    const double before = ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, parameter_.mu()).scaled;
    const Multipliers old_multipliers = multipliers_;
    const double alpha = std::min(MaxPrimalStep(barrier_, point_, step_.w, parameter_.tau()),
                                  MaxDualStep(multipliers_, step_.multipliers, parameter_.tau()));
    ++trials_;
    if (!Try(alpha, step_.w)) return false;
    dual_step_ = alpha;
    Accept(alpha, step_);
    if (Linearise() && ComputeOptimalityError(barrier_, point_, multipliers_, lagrangian_, parameter_.mu()).scaled <=
                           kWorthwhile * before) {
      return true;
    }
    std::swap(point_, trial_);
    multipliers_ = old_multipliers;
    return false;
  }

  // The recentred step, if it is longer in one and not much shorter in the other of primal and dual, and the filter
  // takes it whole.
  bool TryRecentred(double alpha) {
    if (!newton_.Recentre(point_, multipliers_, parameter_.mu(), step_, std::min(1.0, alpha + kLengthening),
                          std::min(1.0, dual_step_ + kLengthening), &corrected_)) {
      return false;
    }
    const double primal = MaxPrimalStep(barrier_, point_, corrected_.w, parameter_.tau());
    const double dual = MaxDualStep(multipliers_, corrected_.multipliers, parameter_.tau());
    if (std::max(primal - alpha, dual - dual_step_) < kLeastGain * kLengthening) return false;
    if (primal < 0.9 * alpha || dual < 0.9 * dual_step_) return false;
    const double slope = from_.slope;
    from_.slope = barrier_gradient_.dot(corrected_.w);
    ++trials_;
    if (Try(primal, corrected_.w) && IsAcceptable(primal)) {
      dual_step_ = dual;
      Accept(primal, corrected_);
      return true;
    }
    from_.slope = slope;
    return false;
  }

  bool Try(double alpha, const VectorX& step) {
    trial_.w = point_.w + alpha * step;
    trial_.c.resize(barrier_.rows());
    return barrier_.Evaluate(&trial_);
  }

  bool IsAcceptable(double alpha) {
    return acceptance_.Accepts(from_, alpha, {trial_.theta, barrier_.Barrier(trial_, parameter_.mu()), 0});
  }

  bool SecondOrderCorrection(double alpha) {
    const double reference_alpha = alpha;
    corrected_c_ = point_.c;
    double last_theta = 0;
    double theta = trial_.theta;
    for (int k = 0; k < kMostCorrections && (k == 0 || theta <= kKappaSoc * last_theta); ++k) {
      last_theta = theta;
      corrected_c_ = alpha * corrected_c_ + trial_.c;
      if (!newton_.Solve(point_, multipliers_, corrected_c_, parameter_.mu(), &corrected_)) return false;
      alpha = MaxPrimalStep(barrier_, point_, corrected_.w, parameter_.tau());
      ++trials_;
      if (!Try(alpha, corrected_.w)) return false;
      if (IsAcceptable(reference_alpha)) {
        dual_step_ = MaxDualStep(multipliers_, corrected_.multipliers, parameter_.tau());
        Accept(alpha, corrected_);
        return true;
      }
      theta = trial_.theta;
    }
    return false;
  }

  void Accept(double alpha, const NewtonStep& step) {
    primal_step_ = alpha;
    step_norm_ = step.w.lpNorm<Eigen::Infinity>();
    std::swap(point_, trial_);
    multipliers_.y += alpha * step.multipliers.y;
    multipliers_.lower += dual_step_ * step.multipliers.lower;
    multipliers_.upper += dual_step_ * step.multipliers.upper;
  }

  double Elapsed() const { return before_s_ + std::chrono::duration<double>(Clock::now() - begin_).count(); }

  void Report() const {
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
    control_.observer(info);
  }

  void Fill(Termination termination, NlpResult* result) const {
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

  NlpProblem& problem_;
  const NlpStart& start_;
  const NlpOptions& options_;
  const SolveControl& control_;
  const Resumption resumption_;
  BarrierProblem barrier_;
  NewtonSystem newton_;
  BarrierParameter parameter_;
  Clock::time_point begin_;

  Point point_, trial_;
  Multipliers multipliers_;
  NewtonStep step_, corrected_;
  StepAcceptance acceptance_;
  LinePoint from_;
  VectorX gradient_, objective_gradient_, barrier_gradient_, lagrangian_, corrected_c_;
  OptimalityError error_;
  double primal_step_ = 0, dual_step_ = 0, step_norm_ = 0;
  double before_s_ = 0;  // spent before the resumption
  int iteration_ = 0, trials_ = 0, tiny_steps_ = 0;
  bool needs_restoration_ = false, asked_ = false, rough_ = false;
};

}  // namespace

InteriorPointResult SolveWithInteriorPoint(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                                           const SolveControl& control, const Resumption& resumption) {
  return Solver(problem, start, options, control, resumption).Run();
}

}  // namespace rollgait
