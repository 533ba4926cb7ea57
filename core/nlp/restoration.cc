#include "core/nlp/restoration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/bound_multipliers.h"
#include "core/nlp/step_length.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

// ρ; resto_penalty_parameter of Ipopt.
constexpr double kPenalty = 1000;

// The barrier parameter falls by Ipopt's settings, whatever those of the solve.
NlpOptions BarrierOptions(const NlpOptions& options) {
  NlpOptions plain;
  plain.tolerance = options.tolerance;
  return plain;
}

}  // namespace

Restoration::Restoration(BarrierProblem& barrier, NewtonSystem& newton, const NlpOptions& options)
    : barrier_(barrier),
      newton_(newton),
      options_(options),
      parameter_(BarrierOptions(options)),
      is_elastic_(VectorX::Ones(barrier.rows())),
      lagrangian_(VectorX::Zero(barrier.unknowns())),
      gradient_(lagrangian_),
      objective_gradient_(lagrangian_) {
  for (const int row : barrier.free_rows()) is_elastic_(row) = 0;
}

double Restoration::eta() const { return std::sqrt(mu()); }

Restoration::End Restoration::Run(const Point& from, const Multipliers& multipliers, double first_mu,
                                  const Watch& watch) {
  SetReference(from);
  return Finish(Begin(multipliers, first_mu) ? Iterate(watch, true) : End::kFailed);
}

Restoration::End Restoration::Resume(const Point& from, const RestorationState& state, const Watch& watch) {
  SetReference(from);
  if (!Restore(state)) return Finish(End::kFailed);
  return Finish(watch.goes_on() ? Iterate(watch, false) : End::kStopped);
}

Restoration::End Restoration::Finish(End end) {
  newton_.SetElastic(nullptr, nullptr);
  newton_.Restore(newton_before_);
  return end;
}

Restoration::End Restoration::Iterate(const Watch& watch, bool is_first) {
  for (bool has_been_reset = is_first;;) {
    if (IsWithin(error_, options_.tolerance)) {
      const bool is_violated = point_.c.lpNorm<Eigen::Infinity>() > AcceptableError(options_.tolerance);
      return is_violated ? End::kInfeasible : End::kFailed;
    }
    if (parameter_.Reduce(false, [this](double barrier) { return ErrorAt(barrier).scaled; })) {
      acceptance_.ForgetFilter();
    }
    if (!ComputeStep() && !(is_first && ComputeStepWithoutCurvature())) return End::kFailed;
    is_first = false;
    if (!LineSearch()) {
      if (has_been_reset) return End::kFailed;
      has_been_reset = true;
      MinimiseElastic();
      acceptance_.ForgetFilter();
      if (!Linearise()) return End::kFailed;
      continue;
    }
    has_been_reset = false;
    barrier_.KeepDistance(point_.w, mu());
    KeepNearCentralPath(barrier_, point_, mu(), &multipliers_);
    if (watch.is_acceptable(point_)) return End::kRestored;
    if (!Linearise()) return End::kFailed;
    if (!watch.goes_on()) return End::kStopped;
  }
}

void Restoration::SetReference(const Point& from) {
  newton_before_ = newton_.memory();
  point_ = from;
  trial_ = from;
  reference_ = from.w.head(barrier_.variables());
  scale_ = reference_.cwiseAbs().cwiseMax(1).cwiseAbs2().cwiseInverse();
}

bool Restoration::Begin(const Multipliers& multipliers, double mu) {
  parameter_.Restore({std::max(mu, point_.c.lpNorm<Eigen::Infinity>()), 1, 0});
  multipliers_.y.setZero(barrier_.rows());
  multipliers_.lower = multipliers.lower.cwiseMin(kPenalty);
  multipliers_.upper = multipliers.upper.cwiseMin(kPenalty);
  NewtonSystem::Memory nothing_but_threshold;
  nothing_but_threshold.threshold = newton_before_.threshold;
  newton_.Restore(nothing_but_threshold);
  MinimiseElastic();
  acceptance_.Begin(0);  // the elastic variables satisfy the constraints
  return Linearise();
}

RestorationState Restoration::State() const {
  return {point_.w, multipliers_, elastic_, parameter_.memory(), acceptance_.memory(), newton_.memory()};
}

bool Restoration::Restore(const RestorationState& state) {
  point_.w = state.w;
  multipliers_ = state.multipliers;
  elastic_ = state.elastic;
  parameter_.Restore(state.barrier);
  acceptance_.Restore(state.acceptance);
  newton_.Restore(state.newton);
  return barrier_.Evaluate(&point_) && Linearise();
}

// p and n that minimise  ρ (p + n) − μ ln p − μ ln n  subject to  p − n = c, and multipliers on the central path.
void Restoration::MinimiseElastic() {
  const int m = barrier_.rows();
  elastic_.p.setZero(m);
  elastic_.n.setZero(m);
  elastic_.z_p.setOnes(m);
  elastic_.z_n.setOnes(m);
  for (int r = 0; r < m; ++r) {
    if (!is_elastic(r)) continue;
    const double c = point_.c(r), half = mu() / (2 * kPenalty);
    // The smaller of the two; the larger is it plus |c|.
    const double b = half - std::abs(c) / 2;
    const double root = std::sqrt(b * b + half * std::abs(c));
    const double least = b > 0 ? b + root : half * std::abs(c) / (root - b);
    elastic_.p(r) = c > 0 ? least + c : least;
    elastic_.n(r) = c > 0 ? least : least - c;
    elastic_.z_p(r) = mu() / elastic_.p(r);
    elastic_.z_n(r) = mu() / elastic_.n(r);
    multipliers_.y(r) = c > 0 ? kPenalty - elastic_.z_p(r) : elastic_.z_n(r) - kPenalty;
  }
}

bool Restoration::Linearise() {
  if (!barrier_.problem().Derivatives(point_.w.data(), 0, multipliers_.y.data(), newton_.kkt().jacobian(),
                                      newton_.kkt().hessian())) {
    return false;
  }
  proximity_ = scale_.cwiseProduct(point_.w.head(barrier_.variables()) - reference_);
  gradient_.setZero();
  AddConstraintGradients(barrier_, newton_.kkt(), multipliers_.y, &gradient_);
  error_ = ErrorAt(0);
  return true;
}

void Restoration::FillLagrangian() {
  lagrangian_ = gradient_;
  lagrangian_.head(barrier_.variables()) += eta() * proximity_;
}

OptimalityError Restoration::ErrorAt(double mu) {
  FillLagrangian();
  OptimalitySum sum(mu);
  sum.AddUnknowns(barrier_, point_, multipliers_, lagrangian_);
  double primal = 0;
  for (int r = 0; r < barrier_.rows(); ++r) {
    if (!is_elastic(r)) continue;
    const double y = multipliers_.y(r);
    primal = std::max(primal, std::abs(point_.c(r) - elastic_.p(r) + elastic_.n(r)));
    sum.AddGradient(kPenalty - y - elastic_.z_p(r));
    sum.AddGradient(kPenalty + y - elastic_.z_n(r));
    sum.AddBound(elastic_.p(r), elastic_.z_p(r));
    sum.AddBound(elastic_.n(r), elastic_.z_n(r));
  }
  return sum.With(primal, multipliers_.y);
}

bool Restoration::ComputeStep() {
  const int m = barrier_.rows();
  curvature_ = eta() * scale_;
  compliance_.setZero(m);
  effective_ = point_;
  for (int r = 0; r < m; ++r) {
    if (!is_elastic(r)) continue;
    const double y = multipliers_.y(r), p = elastic_.p(r), n = elastic_.n(r);
    const double soft_p = p / elastic_.z_p(r), soft_n = n / elastic_.z_n(r);
    compliance_(r) = soft_p + soft_n;
    effective_.c(r) += n - p - (y - kPenalty + mu() / p) * soft_p - (y + kPenalty - mu() / n) * soft_n;
  }
  newton_.SetElastic(&curvature_, &compliance_);
  FillLagrangian();
  if (!newton_.Compute(effective_, multipliers_, lagrangian_, mu(), &step_)) return false;
  // Of p and n the larger would be a difference of numbers of the size of ρ over a curvature of μ/p²: rounding. It
  // follows from the smaller one and the row.
  LinearChange();
  elastic_step_.p.setZero(m);
  elastic_step_.n = elastic_step_.z_p = elastic_step_.z_n = elastic_step_.p;
  for (int r = 0; r < m; ++r) {
    if (!is_elastic(r)) continue;
    const double y = multipliers_.y(r) + step_.multipliers.y(r), p = elastic_.p(r), n = elastic_.n(r);
    const double z_p = elastic_.z_p(r), z_n = elastic_.z_n(r);
    const double difference = change_(r) + point_.c(r) - p + n;  // of Δp and Δn, by the linearised row
    if (p > n) {
      elastic_step_.n(r) = (-y - kPenalty + mu() / n) * n / z_n;
      elastic_step_.p(r) = difference + elastic_step_.n(r);
    } else {
      elastic_step_.p(r) = (y - kPenalty + mu() / p) * p / z_p;
      elastic_step_.n(r) = elastic_step_.p(r) - difference;
    }
    elastic_step_.z_p(r) = MultiplierStep(p, z_p, elastic_step_.p(r), mu());
    elastic_step_.z_n(r) = MultiplierStep(n, z_n, elastic_step_.n(r), mu());
  }
  return true;
}

// With multipliers of rows of up to ρ, as those of the elastic variables are, the curvature of the rows may outweigh
// all else; Ipopt begins with 0.
bool Restoration::ComputeStepWithoutCurvature() {
  multipliers_.y.setZero();
  return Linearise() && ComputeStep();
}

// Δc by the Jacobian.
void Restoration::LinearChange() {
  const SparsityPattern& pattern = barrier_.problem().jacobian_pattern();
  const double* value = newton_.kkt().jacobian();
  change_.setZero(barrier_.rows());
  for (int e = 0; e < pattern.size(); ++e) change_(pattern.rows[e]) += value[e] * step_.w(pattern.columns[e]);
  for (size_t k = 0; k < barrier_.slack_rows().size(); ++k) {
    change_(barrier_.slack_rows()[k]) -= step_.w(barrier_.variables() + static_cast<int>(k));
  }
}

// θ and φ of the problem of restoration.
LinePoint Restoration::At(const Point& point, const ElasticVariables& elastic) const {
  const auto moved = point.w.head(barrier_.variables()) - reference_;
  double objective = 0.5 * eta() * moved.cwiseAbs2().cwiseProduct(scale_).sum(), logarithms = 0;
  objective += kPenalty * (elastic.p.sum() + elastic.n.sum());
  for (int r = 0; r < barrier_.rows(); ++r) {
    if (is_elastic(r)) logarithms += std::log(elastic.p(r)) + std::log(elastic.n(r));
  }
  return {(point.c - elastic.p + elastic.n).lpNorm<1>(), barrier_.Barrier(objective, point.w, mu()) - mu() * logarithms,
          0};
}

double Restoration::Slope() {
  objective_gradient_.head(barrier_.variables()) = eta() * proximity_;
  barrier_.AddBarrierGradient(point_, mu(), objective_gradient_, &barrier_gradient_);
  double slope = barrier_gradient_.dot(step_.w);
  for (int r = 0; r < barrier_.rows(); ++r) {
    if (!is_elastic(r)) continue;
    slope += (kPenalty - mu() / elastic_.p(r)) * elastic_step_.p(r);
    slope += (kPenalty - mu() / elastic_.n(r)) * elastic_step_.n(r);
  }
  return slope;
}

bool Restoration::LineSearch() {
  LinePoint from = At(point_, elastic_);
  from.slope = Slope();
  double alpha = std::min({MaxPrimalStep(barrier_, point_, step_.w, parameter_.tau()),
                           MaxPositiveStep(elastic_.p, elastic_step_.p, parameter_.tau()),
                           MaxPositiveStep(elastic_.n, elastic_step_.n, parameter_.tau())});
  dual_step_ = std::min({MaxDualStep(multipliers_, step_.multipliers, parameter_.tau()),
                         MaxPositiveStep(elastic_.z_p, elastic_step_.z_p, parameter_.tau()),
                         MaxPositiveStep(elastic_.z_n, elastic_step_.z_n, parameter_.tau())});
  const double least = acceptance_.SmallestStep(from);
  trials_ = 0;
  for (bool first = true; first || alpha > least; first = false, alpha *= 0.5) {
    ++trials_;
    trial_.w = point_.w + alpha * step_.w;
    if (!barrier_.Evaluate(&trial_)) continue;
    trial_elastic_.p = elastic_.p + alpha * elastic_step_.p;
    trial_elastic_.n = elastic_.n + alpha * elastic_step_.n;
    if (!acceptance_.Accepts(from, alpha, At(trial_, trial_elastic_))) continue;
    Accept(alpha);
    return true;
  }
  return false;
}

void Restoration::Accept(double alpha) {
  primal_step_ = alpha;
  step_norm_ = step_.w.lpNorm<Eigen::Infinity>();
  std::swap(point_, trial_);
  std::swap(elastic_.p, trial_elastic_.p);
  std::swap(elastic_.n, trial_elastic_.n);
  multipliers_.y += alpha * step_.multipliers.y;
  multipliers_.lower += dual_step_ * step_.multipliers.lower;
  multipliers_.upper += dual_step_ * step_.multipliers.upper;
  for (int r = 0; r < barrier_.rows(); ++r) {
    if (!is_elastic(r)) continue;
    elastic_.z_p(r) = NearCentralPath(elastic_.p(r), elastic_.z_p(r) + dual_step_ * elastic_step_.z_p(r), mu());
    elastic_.z_n(r) = NearCentralPath(elastic_.n(r), elastic_.z_n(r) + dual_step_ * elastic_step_.z_n(r), mu());
  }
}

}  // namespace rollgait
