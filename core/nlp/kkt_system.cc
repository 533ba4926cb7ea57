#include "core/nlp/kkt_system.h"

#include <algorithm>
#include <cmath>
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
// Where weights are bounded: the least d of a row with a slack in the factors, relative to the square of its largest
// entry; what is smaller counts in refinement alone. The row adds 1 / d times the product of its entries to the reduced
// matrix, and the rounding of that, 2e-16 / 1e-14, is an error of the other entries of the same variables, which
// refinement has to contract. Not the first choice: where the row hardly depends on the variables, d decides, and
// refinement is slow to find it.
constexpr double kLeastCompliance = 1e-14;
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

KktSystem::KktSystem(const NlpProblem& problem, std::vector<char> fixed, const std::vector<int>& slack_rows,
                     double fine_residual)
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
      condensed_(FindCondensed(slack_rows)),
      place_(PlacesWithout(condensed_)),
      factors_(MakeFactors(problem)),
      right_(VectorX::Zero(variables_ + rows_)),
      solution_(right_),
      residual_(right_),
      correction_(right_) {
  const SparsityPattern& pattern = matrix_.pattern();
  const auto is_fixed = [this](int unknown) { return unknown < variables_ && fixed_[unknown] != 0; };
  for (int e = 0; e < pattern.size(); ++e) {
    if (is_fixed(pattern.rows[e]) || is_fixed(pattern.columns[e])) fixed_entries_.push_back(e);
  }
}

std::vector<KktSystem::Condensed> KktSystem::FindCondensed(const std::vector<int>& slack_rows) const {
  std::vector<Condensed> condensed(slack_rows.size());
  std::vector<int> index(rows_, -1);
  for (size_t k = 0; k < slack_rows.size(); ++k) {
    condensed[k].row = slack_rows[k];
    index[slack_rows[k]] = static_cast<int>(k);
  }
  for (int e = 0; e < jacobian_pattern_.size(); ++e) {
    const int k = index[jacobian_pattern_.rows[e]];
    if (k >= 0 && fixed_[jacobian_pattern_.columns[e]] == 0) condensed[k].entries.push_back(e);
  }
  return condensed;
}

std::vector<int> KktSystem::PlacesWithout(const std::vector<Condensed>& condensed) const {
  std::vector<int> places(variables_ + rows_, 0);
  for (const Condensed& row : condensed) places[variables_ + row.row] = -1;
  int place = 0;
  for (int& p : places) {
    if (p == 0) p = place++;
  }
  return places;
}

FrontalLdlt KktSystem::MakeFactors(const NlpProblem& problem) {
  const SparsityPattern& whole = matrix_.pattern();
  size_t size = whole.rows.size();
  for (const Condensed& row : condensed_) size += row.entries.size() * (row.entries.size() + 1) / 2;
  SparsityPattern pattern;
  pattern.rows.reserve(size);
  pattern.columns.reserve(size);
  reduced_source_.reserve(whole.rows.size());
  for (int e = 0; e < whole.size(); ++e) {
    const int row = place_[whole.rows[e]], column = place_[whole.columns[e]];
    if (row < 0 || column < 0) continue;
    pattern.Add(row, column);
    reduced_source_.push_back(e);
  }
  for (const Condensed& row : condensed_) {
    for (size_t i = 0; i < row.entries.size(); ++i) {
      for (size_t j = 0; j <= i; ++j) {
        pattern.Add(place_[jacobian_pattern_.columns[row.entries[i]]],
                    place_[jacobian_pattern_.columns[row.entries[j]]]);
      }
    }
  }
  const EliminationGroups groups = problem.elimination_groups();
  std::vector<int> kept = groups.variables;
  for (int r = 0; r < rows_; ++r) {
    if (place_[variables_ + r] >= 0) kept.push_back(groups.constraints[r]);
  }
  reduced_values_ = VectorX::Zero(pattern.size());
  reduced_ = VectorX::Zero(static_cast<int>(kept.size()));
  return FrontalLdlt(static_cast<int>(kept.size()), pattern, kept);
}

KktSystem::Outcome KktSystem::Factorise(const VectorX& primal_diagonal, const VectorX& dual_diagonal) {
  values_.segment(primal_start_, variables_) = primal_diagonal;
  values_.segment(dual_start_, rows_) = -dual_diagonal;
  matrix_.Assign(values_.data());
  for (int e : fixed_entries_) matrix_.value(e) = 0;
  for (int i = 0; i < variables_; ++i) {
    if (fixed_[i] != 0) matrix_.value(matrix_.place(primal_start_ + i)) = 1;
  }
  const Outcome outcome = FactoriseReduced();
  return outcome != Outcome::kRight && BoundWeights() ? FactoriseReduced() : outcome;
}

KktSystem::Outcome KktSystem::FactoriseReduced() {
  AssignReduced();
  factored_threshold_ = threshold_;
  const FrontalLdlt::Inertia inertia = factors_.Factorise(reduced_values_.data(), threshold_);
  if (inertia.zero > 0) return Outcome::kSingular;
  const int condensed = static_cast<int>(condensed_.size());
  return inertia.negative == rows_ - condensed ? Outcome::kRight : Outcome::kWrongInertia;
}

void KktSystem::AssignReduced() {
  double* value = reduced_values_.data();
  for (const int e : reduced_source_) *value++ = matrix_.values()[e];
  const double* derivative = jacobian();
  has_large_weights_ = false;
  for (Condensed& row : condensed_) {
    double largest = 0;
    for (const int e : row.entries) largest = std::max(largest, std::abs(derivative[e]));
    const double least = kLeastCompliance * largest * largest, own = -values_(dual_start_ + row.row);
    has_large_weights_ |= own < least;
    row.compliance = bounds_weights_ ? std::max(least, own) : own;
    const double weight = 1 / row.compliance;
    for (size_t i = 0; i < row.entries.size(); ++i) {
      const double scaled = weight * derivative[row.entries[i]];
      for (size_t j = 0; j <= i; ++j) *value++ = scaled * derivative[row.entries[j]];
    }
  }
}

// Solves the whole system with the factors of the reduced one.
void KktSystem::SolveReduced(const VectorX& right, VectorX* solution) {
  const double* derivative = jacobian();
  for (int i = 0; i < variables_ + rows_; ++i) {
    if (place_[i] >= 0) reduced_(place_[i]) = right(i);
  }
  for (const Condensed& row : condensed_) {
    const double share = right(variables_ + row.row) / row.compliance;
    for (const int e : row.entries) reduced_(jacobian_pattern_.columns[e]) += derivative[e] * share;
  }
  factors_.Solve(reduced_.data());
  for (int i = 0; i < variables_ + rows_; ++i) {
    if (place_[i] >= 0) (*solution)(i) = reduced_(place_[i]);
  }
  for (const Condensed& row : condensed_) {
    double sum = -right(variables_ + row.row);
    for (const int e : row.entries) sum += derivative[e] * reduced_(jacobian_pattern_.columns[e]);
    (*solution)(variables_ + row.row) = sum / row.compliance;
  }
}

bool KktSystem::BoundWeights() { return has_large_weights_ && !std::exchange(bounds_weights_, true); }

bool KktSystem::TryHarder() { return threshold_ > factored_threshold_ || BoundWeights(); }

bool KktSystem::Solve(const VectorX& a, const VectorX& b, VectorX* u, VectorX* v) {
  right_.head(variables_) = a;
  right_.tail(rows_) = b;
  for (int i = 0; i < variables_; ++i) {
    if (fixed_[i] != 0) right_(i) = 0;
  }
  const double size = right_.lpNorm<Eigen::Infinity>();
  SolveReduced(right_, &solution_);
  double error = 0, last_error = kInfinity;
  for (int trial = 0; trial <= kMostRefinements; ++trial) {
    matrix_.Multiply(solution_, &residual_);
    residual_ = right_ - residual_;
    const double scale = std::min(solution_.lpNorm<Eigen::Infinity>(), 1e6 * size) + size;
    error = scale > 0 ? residual_.lpNorm<Eigen::Infinity>() / scale : 0;
    if (!(error > fine_residual_) || trial == kMostRefinements || error > kStagnation * last_error) break;
    last_error = error;
    SolveReduced(residual_, &correction_);
    solution_ += correction_;
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
