#include "core/transcription/collocation_nlp.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace rollgait {
CollocationNlp::~CollocationNlp() = default;

CollocationNlp::CollocationNlp(const OptimalControlProblem& problem, Scheme scheme, const Mesh& mesh,
                               AddedConstraints added)
    : problem_(problem),
      returned_(ReturnedPointsOf(scheme)),
      scheme_(TableauOf(scheme)),
      mesh_(mesh),
      added_(std::move(added)),
      layout_(problem, mesh, scheme_.points()),
      workspace_(problem, scheme_.tableau().starts_at_node()),
      entries_(problem, layout_, &workspace_),
      jumps_(problem, layout_, &workspace_) {
  int largest = 0;
  for (size_t p = 0; p < problem.phases.size(); ++p) {
    blocks_.push_back(std::make_unique<IntervalBlock>(problem, added_, static_cast<int>(p), scheme_, &workspace_));
    largest = std::max(largest, blocks_.back()->local_size());
  }
  for (const CostDescription& cost : problem.costs) {
    coupling_.push_back(MakeCouplingTerm(problem, cost, layout_, scheme_));
  }
  if (problem.ends) {
    AddDisplacementRow(problem, layout_, &linear_);
  } else {
    AddPeriodicityRows(problem, layout_, &linear_);
  }
  AddJumpPositionRows(problem, layout_, &linear_);
  AddTravelRows(problem, layout_, &linear_);
  AddContinuityRows(problem, layout_, scheme_, &linear_);
  SetDenominator();
  SetStateBounds();
  SetControlBounds();
  SetRowBounds();
  ScaleObjective();
  BuildPatterns();
  integrals_ = weights_ = VectorX::Zero(static_cast<int>(problem.costs.size()));
  local_gradient_ = VectorX::Zero(largest + 1);
  cost_gradient_ = VectorX::Zero(variables());
}

void CollocationNlp::SetDenominator() {
  switch (problem_.denominator) {
    case CostDenominator::kDistance:
      denominator_ = {layout_.displacement()};
      break;
    case CostDenominator::kTime:
      for (int p = 0; p < layout_.phases(); ++p) denominator_.push_back(layout_.duration(p));
      break;
    case CostDenominator::kNothing:
      break;
  }
}

void CollocationNlp::ScaleObjective() {
  double typical = 0;
  for (const CostDescription& cost : problem_.costs) typical += cost.weight * cost.Typical();
  // Integrals are per second; a metre takes about a second.
  objective_scale_ = typical > 0 ? kTypicalScaled / typical : 1;
}

int CollocationNlp::GlobalColumn(int interval, int local) const {
  const int p = layout_.phase(interval);
  return local == blocks_[p]->local_size() ? layout_.duration(p) : layout_.node(interval) + local;
}

void CollocationNlp::BuildPatterns() {
  int row0 = 0;
  std::set<int> cost;
  for (int k = 0; k < layout_.intervals(); ++k) {
    const IntervalBlock& block = *blocks_[layout_.phase(k)];
    for (const auto& [r, c] : block.jacobian_pattern()) jacobian_pattern_.Add(row0 + r, GlobalColumn(k, c));
    for (const auto& [r, c] : block.hessian_pattern()) hessian_pattern_.Add(GlobalColumn(k, r), GlobalColumn(k, c));
    for (int c : block.cost_variables()) cost.insert(GlobalColumn(k, c));
    row0 += block.rows();
  }
  entries_.AddPatterns(first_entry_row_, &jacobian_pattern_, &hessian_pattern_);
  jumps_.AddPatterns(first_jump_row_, &jacobian_pattern_, &hessian_pattern_);
  linear_.AddPattern(first_linear_row_, &jacobian_pattern_);
  for (const auto& term : coupling_) {
    if (!term) continue;
    cost.insert(term->unknowns().begin(), term->unknowns().end());
    for (const auto& [r, c] : term->hessian_pattern()) hessian_pattern_.Add(r, c);
  }
  cost_unknowns_.assign(cost.begin(), cost.end());
  AddDenominatorPattern();
}

// ∂N against ∂I, then ∂N against ∂N; DenominatorHessian delivers in this order.
void CollocationNlp::AddDenominatorPattern() {
  for (int d : denominator_) {
    for (int c : cost_unknowns_) hessian_pattern_.Add(d, c);
    // Every integral depends on the durations.
    for (int p = 0; p < layout_.phases(); ++p) {
      hessian_pattern_.Add(std::max(d, layout_.duration(p)), std::min(d, layout_.duration(p)));
    }
  }
  for (int a : denominator_) {
    for (int b : denominator_) {
      if (b <= a) hessian_pattern_.Add(a, b);
    }
  }
}

double CollocationNlp::duration(const double* x) const {
  double sum = 0;
  for (int p = 0; p < layout_.phases(); ++p) sum += x[layout_.duration(p)];
  return sum;
}

double CollocationNlp::Denominator(const double* x) const {
  if (denominator_.empty()) return 1;
  double sum = 0;
  for (int d : denominator_) sum += x[d];
  return sum;
}

double CollocationNlp::WeightedIntegral(const double* x, CostForm form) {
  integrals_.setZero();
  for (int k = 0; k < layout_.intervals(); ++k) {
    blocks_[layout_.phase(k)]->Integrals(x + layout_.node(k), Step(x, k), form, integrals_.data());
  }
  double sum = 0;
  for (size_t t = 0; t < coupling_.size(); ++t) {
    double& integral = integrals_(static_cast<int>(t));
    if (coupling_[t]) integral = coupling_[t]->Integral(x);
    sum += problem_.costs[t].weight * integral;
  }
  return sum;
}

VectorX CollocationNlp::CostIntegrals(const double* x, CostForm form) {
  WeightedIntegral(x, form);
  return integrals_;
}

bool CollocationNlp::Objective(const double* x, double* value) {
  *value = objective_scale_ * WeightedIntegral(x) / Denominator(x);
  return std::isfinite(*value);
}

void CollocationNlp::SetWeights(double factor) {
  for (size_t t = 0; t < coupling_.size(); ++t) weights_(static_cast<int>(t)) = factor * problem_.costs[t].weight;
}

void CollocationNlp::AddCouplingGradient(const double* x, double* gradient) {
  for (size_t t = 0; t < coupling_.size(); ++t) {
    if (coupling_[t]) coupling_[t]->AddGradient(x, weights_(static_cast<int>(t)), gradient);
  }
}

bool CollocationNlp::Gradient(const double* x, double* gradient) {
  Eigen::Map<VectorX> out(gradient, variables());
  out.setZero();
  const double denominator = Denominator(x);
  const double factor = objective_scale_ / denominator;
  SetWeights(factor);
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    const int size = block.local_size();
    block.CostGradient(x + layout_.node(k), Step(x, k), weights_.data(), local_gradient_.head(size + 1));
    out.segment(layout_.node(k), size) += local_gradient_.head(size);
    out(layout_.duration(layout_.phase(k))) += StepRatio(k) * local_gradient_(size);
  }
  AddCouplingGradient(x, gradient);
  if (!denominator_.empty()) {
    const double share = factor * WeightedIntegral(x) / denominator;
    for (int d : denominator_) out(d) -= share;
  }
  return out.allFinite();
}

bool CollocationNlp::Constraints(const double* x, double* g) {
  int row = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    block.Values(x + layout_.node(k), Step(x, k), g + row);
    row += block.rows();
  }
  entries_.Values(x, g + first_entry_row_);
  jumps_.Values(x, g + first_jump_row_);
  linear_.Values(x, g + first_linear_row_);
  return Eigen::Map<const VectorX>(g, rows_).allFinite();
}

// Of the rows and integrands of the intervals; leaves the gradient of the integrands in cost_gradient_. Moves the
// pointers that are not null to the end of what it wrote.
void CollocationNlp::IntervalDerivatives(const double* x, const double* lambda, double** jacobian, double** hessian) {
  cost_gradient_.setZero();
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    const int size = block.local_size();
    const double ratio = StepRatio(k);
    block.Derivatives(x + layout_.node(k), Step(x, k), lambda, weights_.data(), *jacobian, *hessian,
                      local_gradient_.head(size + 1));
    if (*jacobian != nullptr) {
      for (const int e : block.jacobian_step_entries()) (*jacobian)[e] *= ratio;
      *jacobian += block.jacobian_pattern().size();
    }
    if (*hessian == nullptr) continue;
    const int by_step_twice = block.hessian_step_entries().back();
    for (const int e : block.hessian_step_entries()) (*hessian)[e] *= e == by_step_twice ? ratio * ratio : ratio;
    *hessian += block.hessian_pattern().size();
    cost_gradient_.segment(layout_.node(k), size) += local_gradient_.head(size);
    cost_gradient_(layout_.duration(layout_.phase(k))) += ratio * local_gradient_(size);
    lambda += block.rows();
  }
}

bool CollocationNlp::Derivatives(const double* x, double sigma, const double* lambda, double* jacobian,
                                 double* hessian) {
  const double factor = sigma * objective_scale_ / Denominator(x);
  SetWeights(factor);
  double *j = jacobian, *h = hessian;
  IntervalDerivatives(x, lambda, &j, &h);
  if (jacobian != nullptr) {
    j = jumps_.Jacobian(x, entries_.Jacobian(x, j));
    linear_.Jacobian(j);
    if (!Eigen::Map<const VectorX>(jacobian, jacobian_pattern_.size()).allFinite()) return false;
  }
  if (hessian == nullptr) return true;
  h = entries_.Hessian(x, lambda + first_entry_row_, h);
  h = jumps_.Hessian(x, lambda + first_jump_row_, h);
  for (size_t t = 0; t < coupling_.size(); ++t) {
    if (!coupling_[t]) continue;
    coupling_[t]->Hessian(x, weights_(static_cast<int>(t)), h);
    h += coupling_[t]->hessian_pattern().size();
  }
  h = DenominatorHessian(x, factor, h);
  ROLLGAIT_CHECK(h == hessian + hessian_pattern_.size());
  return Eigen::Map<const VectorX>(hessian, hessian_pattern_.size()).allFinite();
}

// f = s I / N: −(s/N²)(∂I ∂Nᵀ + ∂N ∂Iᵀ) + 2 s I/N³ ∂N ∂Nᵀ, with s/N already in cost_gradient_. Returns the end.
double* CollocationNlp::DenominatorHessian(const double* x, double factor, double* values) {
  if (denominator_.empty()) return values;
  const double denominator = Denominator(x);
  AddCouplingGradient(x, cost_gradient_.data());
  for (int d : denominator_) {
    for (int c : cost_unknowns_) *values++ = -cost_gradient_(c) / denominator;
    for (int p = 0; p < layout_.phases(); ++p) {
      const int t = layout_.duration(p);
      *values++ = -cost_gradient_(t) / denominator * (t == d ? 2 : 1);
    }
  }
  const double curvature = 2 * factor * WeightedIntegral(x) / (denominator * denominator);
  for (int a : denominator_) {
    for (int b : denominator_) {
      if (b <= a) *values++ = curvature;
    }
  }
  return values;
}

RowInfo CollocationNlp::Describe(const double* x, int row) const {
  if (row >= first_linear_row_) return linear_.Describe(row - first_linear_row_);
  if (row >= first_jump_row_) return jumps_.Describe(x, row - first_jump_row_);
  if (row >= first_entry_row_) return entries_.Describe(x, row - first_entry_row_);
  double phase_start = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int p = layout_.phase(k);
    if (k > 0 && p != layout_.phase(k - 1)) phase_start += x[layout_.duration(p - 1)];
    if (row < blocks_[p]->rows()) {
      const auto info = blocks_[p]->Describe(row);
      const double time =
          phase_start + x[layout_.duration(p)] * layout_.start(k) + Step(x, k) * scheme_.tableau().c(info.point);
      return {info.name, info.unit, info.size, p, time};
    }
    row -= blocks_[p]->rows();
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
