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

KktSystem::KktSystem(const NlpProblem& problem, std::vector<char> fixed, const std::vector<int>& slack_rows,
                     double fine_residual)
    : variables_(problem.variables()),
      rows_(problem.constraints()),
      jacobian_pattern_(problem.jacobian_pattern()),
      jacobian_start_(problem.hessian_pattern().size()),
      fixed_(std::move(fixed)),
      values_(VectorX::Zero(jacobian_start_ + jacobian_pattern_.size())),
      condensed_(slack_rows.begin(), slack_rows.end()),
      place_(Places(problem)),
      condensed_terms_(CondensedTerms()),
      matrix_(kept(), MatrixPattern(problem)),
      factors_(kept(), matrix_.pattern(), GroupsByPlace(problem), condensed_terms_),
      fine_residual_(fine_residual),
      threshold_(kFirstThreshold),
      weights_(VectorX::Ones(static_cast<int>(condensed_.size()))),
      right_(VectorX::Zero(variables_ + rows_)),
      solution_(right_),
      residual_(right_),
      correction_(right_) {}

// Of equal groups the variables come before the rows.
std::vector<int> KktSystem::Places(const NlpProblem& problem) const {
  const EliminationGroups groups = problem.elimination_groups();
  std::vector<char> is_condensed(variables_ + rows_, 0);
  std::vector<int> places(variables_ + rows_), order;
  int last = kept();
  for (const Condensed& row : condensed_) {
    is_condensed[variables_ + row.row] = 1;
    places[variables_ + row.row] = last++;
  }
  for (int i = 0; i < variables_ + rows_; ++i) {
    if (is_condensed[i] == 0) order.push_back(i);
  }
  const auto group = [&](int i) { return i < variables_ ? groups.variables[i] : groups.constraints[i - variables_]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return group(a) < group(b); });
  for (size_t k = 0; k < order.size(); ++k) places[order[k]] = static_cast<int>(k);
  return places;
}

std::vector<int> KktSystem::GroupsByPlace(const NlpProblem& problem) const {
  const EliminationGroups groups = problem.elimination_groups();
  std::vector<int> by_place(kept());
  for (int i = 0; i < variables_; ++i) by_place[place_[i]] = groups.variables[i];
  for (int r = 0; r < rows_; ++r) {
    const int place = place_[variables_ + r];
    if (place < kept()) by_place[place] = groups.constraints[r];
  }
  return by_place;
}

OuterProducts KktSystem::CondensedTerms() const {
  std::vector<std::vector<int>> entries(condensed_.size());
  for (int e = 0; e < jacobian_pattern_.size(); ++e) {
    const int term = place_[variables_ + jacobian_pattern_.rows[e]] - kept();
    if (term >= 0 && fixed_[jacobian_pattern_.columns[e]] == 0) entries[term].push_back(e);
  }
  OuterProducts terms;
  for (const std::vector<int>& row : entries) {
    for (const int e : row) terms.Add(place_[jacobian_pattern_.columns[e]], e);
    terms.EndTerm();
  }
  return terms;
}

// Of H and J, by places; entries of fixed variables and of condensed rows are left out.
SparsityPattern KktSystem::MatrixPattern(const NlpProblem& problem) const {
  const SparsityPattern& hessian = problem.hessian_pattern();
  SparsityPattern pattern;
  pattern.rows.reserve(values_.size());
  pattern.columns.reserve(values_.size());
  for (int e = 0; e < hessian.size(); ++e) {
    const int row = hessian.rows[e], column = hessian.columns[e];
    const bool is_fixed = fixed_[row] != 0 || fixed_[column] != 0;
    pattern.Add(is_fixed ? -1 : place_[row], place_[column]);
  }
  for (int e = 0; e < jacobian_pattern_.size(); ++e) {
    const int row = place_[variables_ + jacobian_pattern_.rows[e]], column = jacobian_pattern_.columns[e];
    pattern.Add(row >= kept() || fixed_[column] != 0 ? -1 : row, place_[column]);
  }
  return pattern;
}

void KktSystem::TakeDerivatives() { matrix_.Assign(values_.data()); }

KktSystem::Outcome KktSystem::Factorise(const VectorX& primal_diagonal, const VectorX& dual_diagonal) {
  for (int i = 0; i < variables_; ++i) matrix_.diagonal(place_[i]) = fixed_[i] != 0 ? 1 : primal_diagonal(i);
  for (int r = 0; r < rows_; ++r) {
    const int place = place_[variables_ + r];
    if (place < kept()) matrix_.diagonal(place) = -dual_diagonal(r);
  }
  for (Condensed& row : condensed_) row.own = dual_diagonal(row.row);
  const Outcome outcome = FactoriseReduced();
  return outcome != Outcome::kRight && BoundWeights() ? FactoriseReduced() : outcome;
}

KktSystem::Outcome KktSystem::FactoriseReduced() {
  const double* derivative = jacobian();
  has_large_weights_ = false;
  for (size_t k = 0; k < condensed_.size(); ++k) {
    double largest = 0;
    for (int i = condensed_terms_.first[k]; i < condensed_terms_.first[k + 1]; ++i) {
      largest = std::max(largest, std::abs(derivative[condensed_terms_.values[i]]));
    }
    Condensed& row = condensed_[k];
    const double least = kLeastCompliance * largest * largest;
    has_large_weights_ |= row.own < least;
    row.compliance = bounds_weights_ ? std::max(least, row.own) : row.own;
    weights_(static_cast<int>(k)) = 1 / row.compliance;
  }
  factored_threshold_ = threshold_;
  const FrontalLdlt::Inertia inertia = factors_.Factorise(matrix_.values(), threshold_, {derivative, weights_.data()});
  if (inertia.zero > 0) return Outcome::kSingular;
  const int condensed = static_cast<int>(condensed_.size());
  return inertia.negative == rows_ - condensed ? Outcome::kRight : Outcome::kWrongInertia;
}

double KktSystem::Product(size_t condensed, const VectorX& x) const {
  const double* derivative = jacobian();
  double sum = 0;
  for (int i = condensed_terms_.first[condensed]; i < condensed_terms_.first[condensed + 1]; ++i) {
    sum += derivative[condensed_terms_.values[i]] * x(condensed_terms_.unknowns[i]);
  }
  return sum;
}

void KktSystem::AddTransposed(size_t condensed, double factor, VectorX* x) const {
  const double* derivative = jacobian();
  for (int i = condensed_terms_.first[condensed]; i < condensed_terms_.first[condensed + 1]; ++i) {
    (*x)(condensed_terms_.unknowns[i]) += derivative[condensed_terms_.values[i]] * factor;
  }
}

// y = the whole matrix times x.
void KktSystem::Multiply(const VectorX& x, VectorX* y) const {
  matrix_.Multiply(x.data(), y->data());
  for (size_t k = 0; k < condensed_.size(); ++k) {
    const int place = kept() + static_cast<int>(k);
    (*y)(place) = Product(k, x) - condensed_[k].own * x(place);
    AddTransposed(k, x(place), y);
  }
}

// Solves the whole system with the factors of the reduced one.
void KktSystem::SolveReduced(const VectorX& right, VectorX* solution) {
  solution->head(kept()) = right.head(kept());
  for (size_t k = 0; k < condensed_.size(); ++k) {
    AddTransposed(k, right(kept() + static_cast<int>(k)) / condensed_[k].compliance, solution);
  }
  factors_.Solve(solution->data());
  for (size_t k = 0; k < condensed_.size(); ++k) {
    const int place = kept() + static_cast<int>(k);
    (*solution)(place) = (Product(k, *solution) - right(place)) / condensed_[k].compliance;
  }
}

bool KktSystem::BoundWeights() { return has_large_weights_ && !std::exchange(bounds_weights_, true); }

bool KktSystem::TryHarder() { return threshold_ > factored_threshold_ || BoundWeights(); }

bool KktSystem::Solve(const VectorX& a, const VectorX& b, VectorX* u, VectorX* v) {
  for (int i = 0; i < variables_; ++i) right_(place_[i]) = fixed_[i] != 0 ? 0 : a(i);
  for (int r = 0; r < rows_; ++r) right_(place_[variables_ + r]) = b(r);
  const double size = right_.lpNorm<Eigen::Infinity>();
  SolveReduced(right_, &solution_);
  double error = 0, last_error = kInfinity;
  for (int trial = 0; trial <= kMostRefinements; ++trial) {
    Multiply(solution_, &residual_);
    residual_ = right_ - residual_;
    const double scale = std::min(solution_.lpNorm<Eigen::Infinity>(), 1e6 * size) + size;
    error = scale > 0 ? residual_.lpNorm<Eigen::Infinity>() / scale : 0;
    if (!(error > fine_residual_) || trial == kMostRefinements || error > kStagnation * last_error) break;
    last_error = error;
    SolveReduced(residual_, &correction_);
    solution_ += correction_;
  }
  u->resize(variables_);
  v->resize(rows_);
  for (int i = 0; i < variables_; ++i) (*u)(i) = solution_(place_[i]);
  for (int r = 0; r < rows_; ++r) (*v)(r) = solution_(place_[variables_ + r]);
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
