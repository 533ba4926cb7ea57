#include "core/nlp/newton_step.h"

#include <algorithm>
#include <cmath>

#include "core/nlp/bound_multipliers.h"

namespace rollgait {
namespace {

// Constants of Ipopt.
constexpr double kLeastShift = 1e-20, kLargestShift = 1e20;
constexpr double kShiftDecrease = 1.0 / 3, kShiftIncrease = 8, kFirstShiftIncrease = 100;
constexpr double kDualShift = 1e-8, kDualShiftExponent = 0.25;
// Where no shift has failed before, it is tried again only after as many iterations as it has failed in a row, up to
// this. Differs from Ipopt, which tries every time: each trial costs a factorisation.
constexpr int kMostSkips = 3;
// Of a slack that is far from its bounds.
constexpr double kLeastCurvature = 1e-20;
// On the diagonal of a row without bounds, it keeps the row's multiplier at 0.
constexpr double kFreeRow = 1e20;
// Products of distance and multiplier within these multiples of μ are central enough.
constexpr double kLeastProduct = 0.1, kLargestProduct = 10;

}  // namespace

NewtonSystem::NewtonSystem(BarrierProblem& barrier, const NlpOptions& options)
    : barrier_(barrier),
      kkt_(barrier.problem(), barrier.fixed(), barrier.slack_rows(), options.step_residual),
      first_shift_(options.first_shift),
      sigma_(VectorX::Zero(barrier.unknowns())),
      right_(sigma_),
      primal_diagonal_(VectorX::Zero(barrier.variables())),
      dual_diagonal_(VectorX::Zero(barrier.rows())),
      a_(primal_diagonal_),
      b_(dual_diagonal_),
      x_(primal_diagonal_),
      slack_compliance_(VectorX::Zero(static_cast<int>(barrier.slack_rows().size()))) {
  no_excess_.lower = no_excess_.upper = excess_.lower = excess_.upper = sigma_;
}

void NewtonSystem::Restore(const Memory& memory) {
  last_shift_ = memory.last_shift;
  zero_failures_ = memory.zero_failures;
  skipped_ = memory.skipped;
  kkt_.set_threshold(memory.threshold);
}

void NewtonSystem::SetElastic(const VectorX* curvature, const VectorX* compliance) {
  elastic_curvature_ = curvature;
  elastic_compliance_ = compliance;
}

bool NewtonSystem::LeastSquaresMultipliers(const VectorX& objective_gradient, Multipliers* multipliers) {
  const int n = barrier_.variables();
  Eigen::Map<VectorX>(kkt_.hessian(), barrier_.problem().hessian_pattern().size()).setZero();
  kkt_.TakeDerivatives();
  primal_diagonal_.setOnes();
  dual_diagonal_.setZero();
  b_.setZero();
  a_ = -(objective_gradient - multipliers->lower.head(n) + multipliers->upper.head(n));
  for (size_t k = 0; k < barrier_.slack_rows().size(); ++k) {
    const int i = n + static_cast<int>(k), row = barrier_.slack_rows()[k];
    dual_diagonal_(row) = 1;
    b_(row) = multipliers->lower(i) - multipliers->upper(i);
  }
  for (const int row : barrier_.free_rows()) dual_diagonal_(row) = kFreeRow;
  if (kkt_.Factorise(primal_diagonal_, dual_diagonal_) != KktSystem::Outcome::kRight) return false;
  return kkt_.Solve(a_, b_, &x_, &multipliers->y);
}

// Of the largest row of |H|: H plus a larger shift is positive definite.
double NewtonSystem::HessianNorm() {
  const SparsityPattern& pattern = barrier_.problem().hessian_pattern();
  a_.setZero();
  for (int e = 0; e < pattern.size(); ++e) {
    const double size = std::abs(kkt_.hessian()[e]);
    a_(pattern.rows[e]) += size;
    if (pattern.rows[e] != pattern.columns[e]) a_(pattern.columns[e]) += size;
  }
  return a_.maxCoeff();
}

bool NewtonSystem::StartRowMultipliers(const BarrierProblem::Point& point, const VectorX& objective_gradient,
                                       double most, Multipliers* multipliers) {
  if (!barrier_.problem().Jacobian(point.w.data(), kkt_.jacobian())) return false;
  if (!LeastSquaresMultipliers(objective_gradient, multipliers) || multipliers->y.lpNorm<Eigen::Infinity>() > most) {
    multipliers->y.setZero();
  }
  return true;
}

bool NewtonSystem::TryShift(double shift, double mu) {
  const int n = barrier_.variables();
  shift_ = shift;
  primal_diagonal_ = sigma_.head(n).array() + shift;
  if (elastic_curvature_ != nullptr) primal_diagonal_ += *elastic_curvature_;
  for (int trial = 0; trial < 2; ++trial) {
    dual_diagonal_.setConstant(degenerate_ ? kDualShift * std::pow(mu, kDualShiftExponent) : 0);
    for (size_t k = 0; k < barrier_.slack_rows().size(); ++k) {
      const double curvature = std::max(sigma_(n + static_cast<int>(k)) + shift, kLeastCurvature);
      slack_compliance_(static_cast<int>(k)) = 1 / curvature;
      dual_diagonal_(barrier_.slack_rows()[k]) = 1 / curvature;
    }
    if (elastic_compliance_ != nullptr) dual_diagonal_ += *elastic_compliance_;
    for (const int row : barrier_.free_rows()) dual_diagonal_(row) = kFreeRow;
    const auto outcome = kkt_.Factorise(primal_diagonal_, dual_diagonal_);
    if (outcome != KktSystem::Outcome::kSingular || degenerate_) return outcome == KktSystem::Outcome::kRight;
    degenerate_ = true;
  }
  return false;
}

bool NewtonSystem::Factorise(double mu) {
  degenerate_ = false;
  if (skipped_ < std::min(zero_failures_, kMostSkips)) {
    ++skipped_;
  } else if (TryShift(0, mu)) {
    zero_failures_ = skipped_ = 0;
    return true;
  } else {
    ++zero_failures_;
    skipped_ = 0;
  }
  const double first = last_shift_ == 0 ? first_shift_ : std::max(kLeastShift, kShiftDecrease * last_shift_);
  const double increase = last_shift_ == 0 ? kFirstShiftIncrease : kShiftIncrease;
  double shift = first;
  while (!TryShift(shift, mu)) {
    if (!degenerate_ && shift > HessianNorm()) {
      // The shifted Hessian is positive definite. What is left to blame are rows that depend on each other: rounding
      // leaves eigenvalues whose sign is chance, which a shift of the multipliers makes negative.
      degenerate_ = true;
      if (TryShift(0, mu)) return true;
      shift = first;
      continue;
    }
    shift *= increase;
    if (shift > kLargestShift) return false;
  }
  last_shift_ = shift;
  return true;
}

bool NewtonSystem::Compute(const BarrierProblem::Point& point, const Multipliers& multipliers,
                           const VectorX& lagrangian, double mu, NewtonStep* step) {
  barrier_.AddBarrierGradient(point, mu, lagrangian, &right_);
  right_ = -right_;
  for (int i = 0; i < barrier_.unknowns(); ++i) {
    sigma_(i) = 0;
    if (barrier_.has_lower(i)) sigma_(i) += multipliers.lower(i) / (point.w(i) - barrier_.lower(i));
    if (barrier_.has_upper(i)) sigma_(i) += multipliers.upper(i) / (barrier_.upper(i) - point.w(i));
  }
  kkt_.TakeDerivatives();
  kkt_.TrustFactors();
  do {
    if (!Factorise(mu)) return false;
    if (Solve(point, multipliers, point.c, mu, step)) return true;
  } while (kkt_.TryHarder());
  return false;
}

bool NewtonSystem::Solve(const BarrierProblem::Point& point, const Multipliers& multipliers, const VectorX& c,
                         double mu, NewtonStep* step) {
  return Solve(point, multipliers, c, mu, right_, no_excess_, step);
}

bool NewtonSystem::Recentre(const BarrierProblem::Point& point, const Multipliers& multipliers, double mu,
                            const NewtonStep& step, double primal, double dual, NewtonStep* recentred) {
  const auto excess = [&](double distance, double change, double z, double z_change) {
    const double product = (distance + primal * change) * (z + dual * z_change);
    const double target = std::clamp(product, kLeastProduct * mu, kLargestProduct * mu);
    return std::max(target - product, -kLargestProduct * mu) / distance;
  };
  shifted_right_ = right_;
  for (int i = 0; i < barrier_.unknowns(); ++i) {
    if (barrier_.has_lower(i)) {
      excess_.lower(i) =
          excess(point.w(i) - barrier_.lower(i), step.w(i), multipliers.lower(i), step.multipliers.lower(i));
    }
    if (barrier_.has_upper(i)) {
      excess_.upper(i) =
          excess(barrier_.upper(i) - point.w(i), -step.w(i), multipliers.upper(i), step.multipliers.upper(i));
    }
    shifted_right_(i) += excess_.lower(i) - excess_.upper(i);
  }
  return Solve(point, multipliers, point.c, mu, shifted_right_, excess_, recentred);
}

bool NewtonSystem::Solve(const BarrierProblem::Point& point, const Multipliers& multipliers, const VectorX& c,
                         double mu, const VectorX& right, const Multipliers& excess, NewtonStep* step) {
  const int n = barrier_.variables();
  a_ = right.head(n);
  b_ = -c;
  for (size_t k = 0; k < barrier_.slack_rows().size(); ++k) {
    const int row = barrier_.slack_rows()[k];
    b_(row) += right(n + static_cast<int>(k)) * slack_compliance_(static_cast<int>(k));
  }
  step->w.resize(barrier_.unknowns());
  if (!kkt_.Solve(a_, b_, &x_, &step->multipliers.y)) return false;
  for (const int row : barrier_.free_rows()) step->multipliers.y(row) = 0;
  step->w.head(n) = x_;
  for (size_t k = 0; k < barrier_.slack_rows().size(); ++k) {
    const int i = n + static_cast<int>(k), row = barrier_.slack_rows()[k];
    step->w(i) = (step->multipliers.y(row) + right(i)) * slack_compliance_(static_cast<int>(k));
  }
  StepBoundMultipliers(barrier_, point, multipliers, step->w, mu, &step->multipliers);
  step->multipliers.lower += excess.lower;
  step->multipliers.upper += excess.upper;
  return true;
}

}  // namespace rollgait
