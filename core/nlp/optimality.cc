#include "core/nlp/optimality.h"

#include <algorithm>
#include <cmath>

namespace rollgait {

OptimalityError ComputeOptimalityError(const BarrierProblem& barrier, const BarrierProblem::Point& point,
                                       const Multipliers& multipliers, const VectorX& lagrangian, double mu) {
  constexpr double kSMax = 100;
  OptimalityError error{0, 0, 0, 0};
  if (point.c.size() > 0) error.primal = point.c.lpNorm<Eigen::Infinity>();
  double sum_z = 0;
  int bounds = 0;
  const auto add_bound = [&](double distance, double z) {
    error.complementarity = std::max(error.complementarity, std::abs(distance * z - mu));
    sum_z += z;
    ++bounds;
  };
  for (int i = 0; i < barrier.unknowns(); ++i) {
    if (barrier.fixed(i)) continue;
    error.dual = std::max(error.dual, std::abs(lagrangian(i) - multipliers.lower(i) + multipliers.upper(i)));
    if (barrier.has_lower(i)) add_bound(point.w(i) - barrier.lower(i), multipliers.lower(i));
    if (barrier.has_upper(i)) add_bound(barrier.upper(i) - point.w(i), multipliers.upper(i));
  }
  const double sum_y = multipliers.y.lpNorm<1>();
  const double dual_scale = std::max(kSMax, (sum_y + sum_z) / std::max(1, barrier.rows() + bounds)) / kSMax;
  const double bound_scale = std::max(kSMax, sum_z / std::max(1, bounds)) / kSMax;
  error.scaled = std::max({error.primal, error.dual / dual_scale, error.complementarity / bound_scale});
  return error;
}

bool IsWithin(const OptimalityError& error, double tolerance) {
  return error.scaled <= tolerance && error.primal <= tolerance && error.dual <= std::max(tolerance, 1e-4) &&
         error.complementarity <= std::max(tolerance, 1e-6);
}

void AddConstraintGradients(const BarrierProblem& barrier, const KktSystem& kkt, const VectorX& y,
                            VectorX* lagrangian) {
  const int n = barrier.variables();
  kkt.AddTransposedProduct(y, lagrangian);
  lagrangian->conservativeResize(barrier.unknowns());
  for (size_t k = 0; k < barrier.slack_rows().size(); ++k) {
    (*lagrangian)(n + static_cast<int>(k)) = -y(barrier.slack_rows()[k]);
  }
}

}  // namespace rollgait
