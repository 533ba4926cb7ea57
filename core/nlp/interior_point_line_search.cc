#include <algorithm>

#include "core/nlp/interior_point_solver.h"
#include "core/nlp/step_length.h"

namespace rollgait {
namespace {

// Constants of the algorithm; names as in Wächter and Biegler, values as in Ipopt.
constexpr double kKappaSoc = 0.99;
constexpr int kMostCorrections = 4;
// Of recentred steps: shorter ones are worth it; how much longer they are to be, and the part of that which is enough.
constexpr double kLongStep = 0.9, kLengthening = 0.6, kLeastGain = 0.1;
// Share of the optimality error that a step past the filter may leave.
constexpr double kWorthwhile = 0.9;

}  // namespace

InteriorPointSolver::Search InteriorPointSolver::LineSearch() {
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

bool InteriorPointSolver::TryForOptimality() {
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

bool InteriorPointSolver::TryRecentred(double alpha) {
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

bool InteriorPointSolver::Try(double alpha, const VectorX& step) {
  trial_.w = point_.w + alpha * step;
  trial_.c.resize(barrier_.rows());
  return barrier_.Evaluate(&trial_);
}

bool InteriorPointSolver::IsAcceptable(double alpha) {
  return acceptance_.Accepts(from_, alpha, {trial_.theta, barrier_.Barrier(trial_, parameter_.mu()), 0});
}

bool InteriorPointSolver::SecondOrderCorrection(double alpha) {
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

void InteriorPointSolver::Accept(double alpha, const NewtonStep& step) {
  primal_step_ = alpha;
  step_norm_ = step.w.lpNorm<Eigen::Infinity>();
  std::swap(point_, trial_);
  multipliers_.y += alpha * step.multipliers.y;
  multipliers_.lower += dual_step_ * step.multipliers.lower;
  multipliers_.upper += dual_step_ * step.multipliers.upper;
}

}  // namespace rollgait
