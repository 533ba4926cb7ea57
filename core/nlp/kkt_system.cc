#include "core/nlp/kkt_system.h"

#include <algorithm>
#include <utility>

namespace rollgait {
namespace {

// Threshold of pivots. Where the reduced Hessian is small beside the equations (1/h² times), larger ones would delay
// pivots through the whole chain; refinement makes up for the growth that small ones allow.
constexpr double kFirstThreshold = 1e-7;
constexpr double kLargestThreshold = 1e-6;
constexpr int kMostRefinements = 6;
// Backward error that is acceptable after all refinements.
constexpr double kPoorResidual = 1e-6;
// A refinement that does not even halve the error is the last one.
constexpr double kStagnation = 0.5;

}  // namespace

SparsityPattern KktSystem::MakePattern(const NlpProblem& problem) {
  const int n = problem.variables();
  const SparsityPattern& jacobian = problem.jacobian_pattern();
  SparsityPattern pattern;
  for (std::vector<int>* indices : {&pattern.rows, &pattern.columns}) {
    indices->reserve(problem.hessian_pattern().size() + jacobian.size() + n + problem.constraints());
  }
  pattern.rows = problem.hessian_pattern().rows;
  pattern.columns = problem.hessian_pattern().columns;
  for (int e = 0; e < jacobian.size(); ++e) pattern.Add(n + jacobian.rows[e], jacobian.columns[e]);
  for (int i = 0; i < n + problem.constraints(); ++i) pattern.Add(i, i);
  return pattern;
}

std::vector<int> KktSystem::MakeGroups(const NlpProblem& problem) {
  EliminationGroups groups = problem.elimination_groups();
  groups.variables.insert(groups.variables.end(), groups.constraints.begin(), groups.constraints.end());
  return groups.variables;
}

KktSystem::KktSystem(const NlpProblem& problem, std::vector<char> fixed, double fine_residual)
    : variables_(problem.variables()),
      rows_(problem.constraints()),
      jacobian_pattern_(problem.jacobian_pattern()),
      jacobian_start_(problem.hessian_pattern().size()),
      primal_start_(jacobian_start_ + jacobian_pattern_.size()),
      dual_start_(primal_start_ + variables_),
      fixed_(std::move(fixed)),
      values_(VectorX::Zero(dual_start_ + rows_)),
      matrix_(variables_ + rows_, MakePattern(problem)),
      fine_residual_(fine_residual),
      threshold_(kFirstThreshold),
      factors_(variables_ + rows_, matrix_.pattern(), MakeGroups(problem)),
      right_(VectorX::Zero(variables_ + rows_)),
      solution_(right_),
      residual_(right_) {
  const SparsityPattern& pattern = matrix_.pattern();
  const auto is_fixed = [this](int unknown) { return unknown < variables_ && fixed_[unknown] != 0; };
  for (int e = 0; e < pattern.size(); ++e) {
    if (is_fixed(pattern.rows[e]) || is_fixed(pattern.columns[e])) fixed_entries_.push_back(e);
  }
}

KktSystem::Outcome KktSystem::Factorise(const VectorX& primal_diagonal, const VectorX& dual_diagonal) {
  values_.segment(primal_start_, variables_) = primal_diagonal;
  values_.segment(dual_start_, rows_) = -dual_diagonal;
  matrix_.Assign(values_.data());
  for (int e : fixed_entries_) matrix_.value(e) = 0;
  for (int i = 0; i < variables_; ++i) {
    if (fixed_[i] != 0) matrix_.value(matrix_.place(primal_start_ + i)) = 1;
  }
  const FrontalLdlt::Inertia inertia = factors_.Factorise(matrix_.values(), threshold_);
  if (inertia.zero > 0) return Outcome::kSingular;
  return inertia.negative == rows_ ? Outcome::kRight : Outcome::kWrongInertia;
}

bool KktSystem::Solve(const VectorX& a, const VectorX& b, VectorX* u, VectorX* v) {
  right_.head(variables_) = a;
  right_.tail(rows_) = b;
  for (int i = 0; i < variables_; ++i) {
    if (fixed_[i] != 0) right_(i) = 0;
  }
  const double size = right_.lpNorm<Eigen::Infinity>();
  solution_ = right_;
  factors_.Solve(solution_.data());
  double error = 0, last_error = kInfinity;
  for (int trial = 0; trial <= kMostRefinements; ++trial) {
    matrix_.Multiply(solution_, &residual_);
    residual_ = right_ - residual_;
    const double scale = std::min(solution_.lpNorm<Eigen::Infinity>(), 1e6 * size) + size;
    error = scale > 0 ? residual_.lpNorm<Eigen::Infinity>() / scale : 0;
    if (!(error > fine_residual_) || trial == kMostRefinements || error > kStagnation * last_error) break;
    last_error = error;
    factors_.Solve(residual_.data());
    solution_ += residual_;
  }
  *u = solution_.head(variables_);
  *v = solution_.tail(rows_);
  if (error > fine_residual_) threshold_ = std::min(kLargestThreshold, 10 * threshold_);
  return solution_.allFinite() && error <= kPoorResidual;
}

void KktSystem::AddTransposedProduct(const VectorX& v, VectorX* y) const {
  const double* value = jacobian();
  for (int e = 0; e < jacobian_pattern_.size(); ++e) {
    (*y)(jacobian_pattern_.columns[e]) += value[e] * v(jacobian_pattern_.rows[e]);
  }
}

}  // namespace rollgait
