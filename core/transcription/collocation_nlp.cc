#include "core/transcription/collocation_nlp.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rollgait {
namespace {

Tableau TableauOf(Scheme scheme) {
  switch (scheme) {
    case Scheme::kRadau2:
      return Radau2();
    case Scheme::kRadau3:
      return Radau3();
    case Scheme::kHermiteSimpson:
      return HermiteSimpson();
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace

CollocationNlp::~CollocationNlp() = default;

CollocationNlp::CollocationNlp(const OptimalControlProblem& problem, Scheme scheme, const Mesh& mesh)
    : problem_(problem),
      scheme_kind_(scheme),
      scheme_(TableauOf(scheme)),
      mesh_(mesh),
      layout_(problem, mesh, scheme_.points()),
      workspace_(problem, scheme_.tableau().starts_at_node()) {
  for (size_t p = 0; p < problem.phases.size(); ++p) {
    blocks_.push_back(std::make_unique<IntervalBlock>(problem, static_cast<int>(p), scheme_, &workspace_));
  }
  integrals_ = weights_ = VectorX::Zero(static_cast<int>(problem.costs.size()));
  link_weights_ = VectorX::Zero(static_cast<int>(problem.model.actuated().size()));
  for (const CostDescription& term : problem.costs) {
    if (!term.integrand) link_weights_ += term.weight * term.effort_rate_weights;
  }
  switch (problem.denominator) {
    case CostDenominator::kDistance:
      denominator_ = {layout_.displacement()};
      break;
    case CostDenominator::kTime:
      for (int p = 0; p < layout_.phases(); ++p) denominator_.push_back(layout_.duration(p));
      break;
    case CostDenominator::kNothing:
      break;
  }
  SetBounds();
  AddIntervalRows();
  AddEntryRows();
  first_linear_row_ = rows_;
  AddPeriodicityRows();
  AddTravelRows();
  AddEffortLinks();
  ScaleObjective();
  BuildPatterns();
  int largest = 0;
  for (const auto& block : blocks_) largest = std::max(largest, block->local_size());
  local_gradient_ = VectorX::Zero(largest + 1);
  cost_gradient_ = VectorX::Zero(variables());
  const int n = problem.model.size();
  entry_z_ = VectorX::Zero(3 * n);
  entry_jacobian_ = MatrixX::Zero(3, 3 * n);
  entry_hessian_ = MatrixX::Zero(3 * n, 3 * n);
}

void CollocationNlp::SetBounds() {
  const int n = problem_.model.size();
  lower_ = VectorX::Constant(variables(), -kInfinity);
  upper_ = VectorX::Constant(variables(), kInfinity);
  for (int k = 0; k <= layout_.intervals(); ++k) {
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem_.model.joint(j);
      lower_(layout_.node(k) + j) = joint.position_min;
      upper_(layout_.node(k) + j) = joint.position_max;
      lower_(layout_.node(k) + n + j) = -joint.velocity_max;
      upper_(layout_.node(k) + n + j) = joint.velocity_max;
    }
  }
  // The first node is where the walk begins; without this the problem could slide along x.
  lower_(layout_.node(0) + problem_.forward_joint) = upper_(layout_.node(0) + problem_.forward_joint) = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (int i = 0; i < scheme_.points(); ++i) {
      for (size_t j = 0; j < problem_.model.actuated().size(); ++j) {
        const Joint& joint = problem_.model.joint(problem_.model.actuated()[j]);
        lower_(layout_.efforts(k, i) + static_cast<int>(j)) = joint.effort_min / problem_.effort_size();
        upper_(layout_.efforts(k, i) + static_cast<int>(j)) = joint.effort_max / problem_.effort_size();
      }
      for (const ActiveContact& active : problem_.ActiveContacts(layout_.phase(k))) {
        const int normal = active.offset + static_cast<int>(active.directions.size()) - 1;
        lower_(layout_.forces(k, i) + normal) = problem_.min_normal_force / problem_.force_size();
      }
    }
  }
  for (int p = 0; p < layout_.phases(); ++p) {
    lower_(layout_.duration(p)) = problem_.phases[p].duration.min;
    upper_(layout_.duration(p)) = problem_.phases[p].duration.max;
  }
  lower_(layout_.displacement()) = problem_.displacement.min;
  upper_(layout_.displacement()) = problem_.displacement.max;
}

void CollocationNlp::AddIntervalRows() {
  std::vector<double> lower, upper;
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int p = layout_.phase(k);
    const int rows = blocks_[p]->rows();
    lower.resize(rows_ + rows);
    upper.resize(rows_ + rows);
    blocks_[p]->Bounds(layout_.start(k), layout_.length(k), layout_.ends_phase(k), lower.data() + rows_,
                       upper.data() + rows_);
    rows_ += rows;
  }
  row_lower_ = Eigen::Map<VectorX>(lower.data(), rows_);
  row_upper_ = Eigen::Map<VectorX>(upper.data(), rows_);
}

void CollocationNlp::AddEntryRows() {
  first_entry_row_ = rows_;
  for (int p = 0; p < layout_.phases(); ++p) {
    for (auto& constraint : problem_.EntryConstraints(p)) {
      EntryRow row;
      row.node = layout_.node(layout_.first_interval(p));
      row.phase = p;
      row.first_row = rows_;
      row.jacobian = constraint->JacobianPattern();
      for (const auto& [a, b] : constraint->HessianPattern()) {
        // (q, v) above the diagonal of blocks is delivered in the upper triangle; take each pair once.
        row.hessian.emplace_back(std::min(a, b), std::max(a, b));
      }
      std::sort(row.hessian.begin(), row.hessian.end());
      row.hessian.erase(std::unique(row.hessian.begin(), row.hessian.end()), row.hessian.end());
      const int rows = constraint->rows();
      row_lower_.conservativeResize(rows_ + rows);
      row_upper_.conservativeResize(rows_ + rows);
      constraint->Bounds(0, row_lower_.data() + rows_, row_upper_.data() + rows_);
      for (int r = 0; r < rows; ++r) {
        row_lower_(rows_ + r) /= constraint->Size(r);
        row_upper_(rows_ + r) /= constraint->Size(r);
      }
      rows_ += rows;
      row.constraint = std::move(constraint);
      entries_.push_back(std::move(row));
    }
  }
}

void CollocationNlp::AddLinearRow(LinearRow row, double lower, double upper) {
  row_lower_.conservativeResize(rows_ + 1);
  row_upper_.conservativeResize(rows_ + 1);
  row_lower_(rows_) = lower / row.size;
  row_upper_(rows_) = upper / row.size;
  for (auto& [unknown, coefficient] : row.terms) coefficient /= row.size;
  linear_.push_back(std::move(row));
  ++rows_;
}

// x_N = mirror(x_0) + displacement along x.
void CollocationNlp::AddPeriodicityRows() {
  const int n = problem_.model.size();
  for (int block = 0; block < 2; ++block) {
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem_.model.joint(j);
      const int source = problem_.mirrored && joint.mirror_joint >= 0 ? joint.mirror_joint : j;
      const double sign = problem_.mirrored ? joint.mirror_sign : 1;
      const bool prismatic = joint.type == JointType::kPrismatic;
      LinearRow row{"periodicity " + joint.name, prismatic ? (block == 0 ? "m" : "m/s") : (block == 0 ? "rad" : "rad/s"),
                    1, {}};
      row.terms.emplace_back(layout_.node(layout_.intervals()) + block * n + j, 1.0);
      row.terms.emplace_back(layout_.node(0) + block * n + source, -sign);
      if (block == 0 && j == problem_.forward_joint) row.terms.emplace_back(layout_.displacement(), -1.0);
      AddLinearRow(std::move(row), 0, 0);
    }
  }
}

void CollocationNlp::AddTravelRows() {
  const auto durations = [this](double coefficient) {
    std::vector<std::pair<int, double>> terms;
    for (int p = 0; p < layout_.phases(); ++p) terms.emplace_back(layout_.duration(p), coefficient);
    return terms;
  };
  const auto speed_row = [&](double speed, double lower, double upper) {
    LinearRow row{"speed", "m", 1, durations(-speed)};
    row.terms.emplace_back(layout_.displacement(), 1.0);
    AddLinearRow(std::move(row), lower, upper);
  };
  if (problem_.speed.min == problem_.speed.max) {
    speed_row(problem_.speed.min, 0, 0);
  } else {
    if (problem_.speed.min > -kInfinity) speed_row(problem_.speed.min, 0, kInfinity);
    if (problem_.speed.max < kInfinity) speed_row(problem_.speed.max, -kInfinity, 0);
  }
  if (problem_.duration.min > -kInfinity || problem_.duration.max < kInfinity) {
    AddLinearRow({"step duration", "s", 1, durations(1)}, problem_.duration.min, problem_.duration.max);
  }
}

void CollocationNlp::AddEffortLinks() {
  if (link_weights_.isZero()) return;
  const int joints = static_cast<int>(problem_.model.actuated().size());
  const VectorX& c = scheme_.tableau().c;
  const int last = scheme_.points() - 1;
  const auto link = [&](int from_interval, int from_point, int to_interval, int to_point, double fraction, bool wrap) {
    EffortLink l;
    for (int j = 0; j < joints; ++j) {
      const Joint& joint = problem_.model.joint(problem_.model.actuated()[j]);
      int source = j;
      double sign = 1;
      if (wrap && problem_.mirrored && joint.mirror_joint >= 0) {
        const auto& actuated = problem_.model.actuated();
        source = static_cast<int>(std::find(actuated.begin(), actuated.end(), joint.mirror_joint) - actuated.begin());
        sign = joint.mirror_sign;
      }
      l.from.push_back(layout_.efforts(from_interval, from_point) + j);
      l.to.push_back(layout_.efforts(to_interval, to_point) + source);
      l.sign.push_back(sign);
    }
    l.phase = layout_.phase(to_interval);
    l.ratio = fraction * StepRatio(to_interval);
    if (fraction > 0) {
      links_.push_back(std::move(l));
      return;
    }
    // The same instant: efforts are continuous there.
    for (int j = 0; j < joints; ++j) {
      AddLinearRow({"continuous effort " + problem_.model.joint(problem_.model.actuated()[j]).name, "N m",
                    1, {{l.from[j], 1.0}, {l.to[j], -l.sign[j]}}}, 0, 0);
    }
  };
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (int i = 0; i < last; ++i) link(k, i, k, i + 1, c(i + 1) - c(i), false);
    const bool wrap = k + 1 == layout_.intervals();
    link(k, last, wrap ? 0 : k + 1, 0, c(0), wrap);
  }
}

void CollocationNlp::ScaleObjective() {
  double typical = 0;
  for (const CostDescription& term : problem_.costs) {
    typical += term.weight * (term.integrand ? term.integrand->Typical() : term.effort_rate_typical);
  }
  // Integrals are per second; a metre takes about a second. 100 keeps the curvature of one node of a fine mesh well above
  // the regularisation that Ipopt adds.
  objective_scale_ = typical > 0 ? 100 / typical : 1;
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
  for (const EntryRow& entry : entries_) {
    for (const auto& [r, c] : entry.jacobian) jacobian_pattern_.Add(entry.first_row + r, entry.node + c);
    for (const auto& [a, b] : entry.hessian) hessian_pattern_.Add(entry.node + b, entry.node + a);
  }
  for (size_t l = 0; l < linear_.size(); ++l) {
    for (const auto& [unknown, coefficient] : linear_[l].terms) {
      jacobian_pattern_.Add(first_linear_row_ + static_cast<int>(l), unknown);
    }
  }
  for (const EffortLink& link : links_) {
    for (size_t j = 0; j < link.from.size(); ++j) {
      cost.insert(link.from[j]);
      cost.insert(link.to[j]);
      hessian_pattern_.Add(link.from[j], link.from[j]);
      hessian_pattern_.Add(link.to[j], link.to[j]);
      hessian_pattern_.Add(std::max(link.from[j], link.to[j]), std::min(link.from[j], link.to[j]));
      hessian_pattern_.Add(layout_.duration(link.phase), link.from[j]);
      hessian_pattern_.Add(layout_.duration(link.phase), link.to[j]);
    }
    hessian_pattern_.Add(layout_.duration(link.phase), layout_.duration(link.phase));
  }
  cost_unknowns_.assign(cost.begin(), cost.end());
  for (int d : denominator_) {
    for (int c : cost_unknowns_) hessian_pattern_.Add(d, c);
    // Against the durations, on which every integral depends, and among themselves.
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

double CollocationNlp::LinkIntegral(const double* x, const VectorX& weights) const {
  double sum = 0;
  const double size = problem_.effort_size();
  for (const EffortLink& link : links_) {
    double squares = 0;
    for (size_t j = 0; j < link.from.size(); ++j) {
      const double difference = size * (link.sign[j] * x[link.to[j]] - x[link.from[j]]);
      squares += weights(static_cast<int>(j)) * difference * difference;
    }
    sum += squares / (link.ratio * x[layout_.duration(link.phase)]);
  }
  return sum;
}

double CollocationNlp::WeightedIntegral(const double* x) {
  integrals_.setZero();
  for (int k = 0; k < layout_.intervals(); ++k) {
    blocks_[layout_.phase(k)]->Integrals(x + layout_.node(k), Step(x, k), integrals_.data());
  }
  double sum = LinkIntegral(x, link_weights_);
  for (size_t t = 0; t < problem_.costs.size(); ++t) {
    if (problem_.costs[t].integrand) sum += problem_.costs[t].weight * integrals_(static_cast<int>(t));
  }
  return sum;
}

VectorX CollocationNlp::CostIntegrals(const double* x) {
  WeightedIntegral(x);
  VectorX integrals = integrals_;
  for (size_t t = 0; t < problem_.costs.size(); ++t) {
    if (!problem_.costs[t].integrand) {
      integrals(static_cast<int>(t)) = LinkIntegral(x, problem_.costs[t].effort_rate_weights);
    }
  }
  return integrals;
}

bool CollocationNlp::Objective(const double* x, double* value) {
  *value = objective_scale_ * WeightedIntegral(x) / Denominator(x);
  return std::isfinite(*value);
}

void CollocationNlp::AddLinkGradient(const double* x, double factor, double* gradient) const {
  const double size = problem_.effort_size();
  for (const EffortLink& link : links_) {
    const double duration = x[layout_.duration(link.phase)], step = link.ratio * duration;
    for (size_t j = 0; j < link.from.size(); ++j) {
      const double difference = size * (link.sign[j] * x[link.to[j]] - x[link.from[j]]);
      const double slope = factor * 2 * link_weights_(static_cast<int>(j)) * difference / step;
      gradient[link.to[j]] += slope * size * link.sign[j];
      gradient[link.from[j]] -= slope * size;
      gradient[layout_.duration(link.phase)] -= 0.5 * slope * difference / duration;
    }
  }
}

bool CollocationNlp::Gradient(const double* x, double* gradient) {
  Eigen::Map<VectorX> out(gradient, variables());
  out.setZero();
  const double denominator = Denominator(x);
  const double factor = objective_scale_ / denominator;
  for (size_t t = 0; t < problem_.costs.size(); ++t) weights_(static_cast<int>(t)) = factor * problem_.costs[t].weight;
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    const int size = block.local_size();
    block.CostGradient(x + layout_.node(k), Step(x, k), weights_.data(), local_gradient_.head(size + 1));
    out.segment(layout_.node(k), size) += local_gradient_.head(size);
    out(layout_.duration(layout_.phase(k))) += StepRatio(k) * local_gradient_(size);
  }
  AddLinkGradient(x, factor, gradient);
  const double integral = WeightedIntegral(x);
  for (int d : denominator_) out(d) -= factor * integral / denominator;
  return out.allFinite();
}

void CollocationNlp::LoadEntry(const double* x, const EntryRow& row, bool second) {
  const int n = problem_.model.size();
  entry_z_.head(2 * n) = Eigen::Map<const VectorX>(x + row.node, 2 * n);
  workspace_.tree.UpdateKinematics(entry_z_.data(), entry_z_.data() + n);
  for (auto& contact : workspace_.contacts) {
    contact.Update(workspace_.tree);
    if (second) contact.UpdateSecond();
  }
}

bool CollocationNlp::Constraints(const double* x, double* g) {
  int row = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    block.Values(x + layout_.node(k), Step(x, k), g + row);
    row += block.rows();
  }
  const PointContext context{entry_z_.data(), &workspace_.tree, &workspace_.contacts, &workspace_.dual_contacts};
  for (const EntryRow& entry : entries_) {
    LoadEntry(x, entry, false);
    entry.constraint->Value(context, g + row);
    for (int r = 0; r < entry.constraint->rows(); ++r) g[row + r] /= entry.constraint->Size(r);
    row += entry.constraint->rows();
  }
  for (const LinearRow& linear : linear_) {
    double sum = 0;
    for (const auto& [unknown, coefficient] : linear.terms) sum += coefficient * x[unknown];
    g[row++] = sum;
  }
  return Eigen::Map<const VectorX>(g, rows_).allFinite();
}

bool CollocationNlp::Jacobian(const double* x, double* values) {
  double* out = values;
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    block.Jacobian(x + layout_.node(k), Step(x, k), out);
    const Entries& pattern = block.jacobian_pattern();
    for (size_t e = 0; e < pattern.size(); ++e) {
      if (pattern[e].second == block.local_size()) out[e] *= StepRatio(k);
    }
    out += pattern.size();
  }
  const PointContext context{entry_z_.data(), &workspace_.tree, &workspace_.contacts, &workspace_.dual_contacts};
  for (const EntryRow& entry : entries_) {
    LoadEntry(x, entry, false);
    entry.constraint->Jacobian(context, entry_jacobian_.topRows(entry.constraint->rows()));
    for (const auto& [r, c] : entry.jacobian) *out++ = entry_jacobian_(r, c) / entry.constraint->Size(r);
  }
  for (const LinearRow& linear : linear_) {
    for (const auto& [unknown, coefficient] : linear.terms) *out++ = coefficient;
  }
  return Eigen::Map<const VectorX>(values, jacobian_pattern_.size()).allFinite();
}

bool CollocationNlp::Hessian(const double* x, double sigma, const double* lambda, double* values) {
  double* out = values;
  const double denominator = Denominator(x);
  const double factor = sigma * objective_scale_ / denominator;
  for (size_t t = 0; t < problem_.costs.size(); ++t) weights_(static_cast<int>(t)) = factor * problem_.costs[t].weight;
  cost_gradient_.setZero();
  int row = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    IntervalBlock& block = *blocks_[layout_.phase(k)];
    const int size = block.local_size();
    block.Hessian(x + layout_.node(k), Step(x, k), lambda + row, weights_.data(), out, local_gradient_.head(size + 1));
    const double ratio = StepRatio(k);
    const Entries& pattern = block.hessian_pattern();
    for (size_t e = 0; e < pattern.size(); ++e) {
      if (pattern[e].first == size) out[e] *= pattern[e].second == size ? ratio * ratio : ratio;
    }
    cost_gradient_.segment(layout_.node(k), size) += local_gradient_.head(size);
    cost_gradient_(layout_.duration(layout_.phase(k))) += ratio * local_gradient_(size);
    out += pattern.size();
    row += block.rows();
  }
  const int n = problem_.model.size();
  const PointContext context{entry_z_.data(), &workspace_.tree, &workspace_.contacts, &workspace_.dual_contacts};
  for (const EntryRow& entry : entries_) {
    LoadEntry(x, entry, true);
    for (int r = 0; r < entry.constraint->rows(); ++r) {
      entry_jacobian_(r, 0) = lambda[entry.first_row + r] / entry.constraint->Size(r);
    }
    const Vector3 scaled(entry_jacobian_(0, 0), entry_jacobian_(1, 0), entry_jacobian_(2, 0));
    entry_hessian_.topLeftCorner(2 * n, 2 * n).setZero();
    entry.constraint->AddHessian(context, scaled.data(), entry_hessian_);
    for (const auto& [a, b] : entry.hessian) *out++ = entry_hessian_(a, b);
  }
  const double size = problem_.effort_size();
  for (const EffortLink& link : links_) {
    const double duration = x[layout_.duration(link.phase)], step = link.ratio * duration;
    double squares = 0;
    for (size_t j = 0; j < link.from.size(); ++j) {
      const double difference = size * (link.sign[j] * x[link.to[j]] - x[link.from[j]]);
      const double curvature = factor * 2 * link_weights_(static_cast<int>(j)) / step;
      *out++ = curvature * size * size;
      *out++ = curvature * size * size;
      *out++ = -curvature * size * size * link.sign[j];
      *out++ = curvature * size * difference / duration;
      *out++ = -curvature * size * difference * link.sign[j] / duration;
      squares += curvature * difference * difference;
    }
    *out++ = squares / (duration * duration);
  }
  // f = s I / N: −(s/N²)(∂I ∂Nᵀ + ∂N ∂Iᵀ) + 2 s I/N³ ∂N ∂Nᵀ, with s/N already in cost_gradient_.
  AddLinkGradient(x, factor, cost_gradient_.data());
  const double integral = denominator_.empty() ? 0 : factor * WeightedIntegral(x);
  for (int d : denominator_) {
    for (int c : cost_unknowns_) *out++ = -cost_gradient_(c) / denominator;
    for (int p = 0; p < layout_.phases(); ++p) {
      const int t = layout_.duration(p);
      *out++ = -cost_gradient_(t) / denominator * (t == d ? 2 : 1);
    }
  }
  for (int a : denominator_) {
    for (int b : denominator_) {
      if (b <= a) *out++ = 2 * integral / (denominator * denominator);
    }
  }
  return Eigen::Map<const VectorX>(values, hessian_pattern_.size()).allFinite();
}

CollocationNlp::RowInfo CollocationNlp::Describe(const double* x, int row) const {
  double phase_start = 0;
  int first = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int p = layout_.phase(k);
    if (k > 0 && p != layout_.phase(k - 1)) phase_start += x[layout_.duration(p - 1)];
    if (row < first + blocks_[p]->rows()) {
      const auto info = blocks_[p]->Describe(row - first);
      const double time =
          phase_start + x[layout_.duration(p)] * layout_.start(k) + Step(x, k) * scheme_.tableau().c(info.point);
      return {info.name, info.unit, info.size, p, time};
    }
    first += blocks_[p]->rows();
  }
  for (const EntryRow& entry : entries_) {
    const int r = row - entry.first_row;
    if (r >= entry.constraint->rows()) continue;
    double time = 0;
    for (int p = 0; p < entry.phase; ++p) time += x[layout_.duration(p)];
    return {entry.constraint->Name(r), entry.constraint->Unit(r), entry.constraint->Size(r), entry.phase, time};
  }
  const LinearRow& linear = linear_[row - first_linear_row_];
  return {linear.name, linear.unit, linear.size, 0, 0};
}

}  // namespace rollgait
