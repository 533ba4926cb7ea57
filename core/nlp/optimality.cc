#include "core/nlp/optimality.h"

namespace rollgait {

void OptimalitySum::AddBound(double distance, double z) {
  complementarity_ = std::max(complementarity_, std::abs(distance * z - mu_));
  sum_z_ += z;
  ++bounds_;
}

void OptimalitySum::AddUnknowns(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                                const Multipliers& multipliers, const VectorX& lagrangian) {
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.fixed(i)) continue;
    AddGradient(lagrangian(i) - multipliers.lower(i) + multipliers.upper(i));
    if (barrier.has_lower(i)) AddBound(point.w(i) - barrier.lower(i), multipliers.lower(i));
    if (barrier.has_upper(i)) AddBound(barrier.upper(i) - point.w(i), multipliers.upper(i));
  }
}

OptimalityError OptimalitySum::With(double primal, const VectorX& y) const {
  constexpr double kSMax = 100;
  const int rows = static_cast<int>(y.size());
  const double sum_y = y.lpNorm<1>();
  const double dual_scale = std::max(kSMax, (sum_y + sum_z_) / std::max(1, rows + bounds_)) / kSMax;
  const double bound_scale = std::max(kSMax, sum_z_ / std::max(1, bounds_)) / kSMax;
  return {primal, dual_, complementarity_, std::max({primal, dual_ / dual_scale, complementarity_ / bound_scale})};
}

OptimalityError ComputeOptimalityError(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                                       const Multipliers& multipliers, const VectorX& lagrangian, double mu) {
  OptimalitySum sum(mu);
  sum.AddUnknowns(barrier, point, multipliers, lagrangian);
  return sum.With(point.c.size() > 0 ? point.c.lpNorm<Eigen::Infinity>() : 0, multipliers.y);
}

bool IsWithin(const OptimalityError& error, double tolerance) {
  return error.scaled <= tolerance && error.primal <= tolerance && error.dual <= std::max(tolerance, 1e-4) &&
         error.complementarity <= std::max(tolerance, 1e-6);
}

void AddConstraintGradients(const BarrierProblem& barrier, const KktSystem& kkt, const VectorX& y,
                            VectorX* lagrangian) {
  const int n = barrier.variables();
  kkt.AddTransposedProduct(y, lagrangian);
  for (size_t k = 0; k < barrier.slack_rows().size(); ++k) {
    (*lagrangian)(n + static_cast<int>(k)) = -y(barrier.slack_rows()[k]);
  }
}

}  // namespace rollgait
