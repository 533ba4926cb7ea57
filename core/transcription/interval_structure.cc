// IntervalBlock's structure: its points, rows and patterns. What depends on the unknowns is in interval_block.cc.

#include <algorithm>
#include <map>

#include "core/transcription/interval_block.h"
#include "core/transcription/layout.h"

namespace rollgait {
namespace {

using Kind = EliminatedScheme::Kind;

}  // namespace

IntervalBlock::IntervalBlock(const OptimalControlProblem& problem, const AddedConstraints& added, int phase,
                             const EliminatedScheme& scheme, PointWorkspace* workspace)
    : problem_(problem),
      phase_(phase),
      scheme_(scheme),
      workspace_(workspace),
      layout_(problem.Layout(phase)),
      points_count_(scheme.points()),
      controls_(layout_.efforts + layout_.forces),
      regular_(problem.PointConstraints(
          phase, scheme.tableau().is_explicit ? PointKind::kStage : PointKind::kCollocation, added.separated)),
      active_contacts_(problem.phases[phase].active) {
  if (scheme.tableau().starts_at_node()) at_node_ = problem.PointConstraints(phase, PointKind::kNode);
  for (const CostDescription& cost : problem.costs) costs_.push_back(cost.integrand());
  local_size_ = 4 * layout_.n + (points_count_ - 2) * layout_.n + points_count_ * controls_;
  scale_ = VectorX::Ones(local_size_);
  scale_.segment(2 * layout_.n, (points_count_ - 2) * layout_.n).setConstant(kAccelerationScale);
  for (int i = 0; i < points_count_; ++i) {
    scale_.segment(ControlOffset(i), layout_.efforts).setConstant(problem.effort_size());
    scale_.segment(ControlOffset(i) + layout_.efforts, layout_.forces).setConstant(problem.force_size());
  }
  for (auto* m : {value_, first_, second_, scaled_}) {
    for (int k = 0; k < 3; ++k) m[k] = MatrixX::Zero(points_count_, scheme.sources());
  }
  context_.tree = &workspace->tree;
  context_.contacts = &workspace->contacts;
  context_.dual_contacts = &workspace->dual_contacts;
  z_ = VectorX::Zero(layout_.size());
  context_.z = z_.data();
  z_rate_ = z_curve_ = VectorX::Zero(3 * layout_.n);
  hessian_ = MatrixX::Zero(layout_.size(), layout_.size());
  for (MatrixX* block : {&qq_, &qv_, &vq_, &qa_, &aq_, &vv_, &aa_}) *block = MatrixX::Zero(layout_.n, layout_.n);
  gradient_ = cost_gradient_ = VectorX::Zero(layout_.size());
  local_ = MatrixX::Zero(local_size_ + 1, local_size_ + 1);
  block_ = MatrixX::Zero(layout_.n, controls_);
  turned_ = VectorX::Zero(3 * layout_.n);
  step_controls_ = VectorX::Zero(controls_);
  BuildPoints();
  BuildPath(added);
  BuildJacobianPattern();
  BuildHessianPattern();
}

void IntervalBlock::BuildPoints() {
  int largest = 0;
  for (int i = 0; i < points_count_; ++i) {
    Point point;
    const bool is_node = i == 0 && !at_node_.empty();
    point.goes_on_rolling = is_node || scheme_.tableau().is_explicit;
    for (const auto& constraint : is_node ? at_node_ : regular_) {
      point.constraints.push_back(constraint.get());
      point.rows += constraint->rows();
    }
    point.first_row = rows_;
    rows_ += point.rows;
    point.row_factor.resize(point.rows);
    point.jacobian = MatrixX::Zero(point.rows, layout_.size());
    int row = 0;
    for (PointConstraint* constraint : point.constraints) {
      for (int r = 0; r < constraint->rows(); ++r) point.row_factor(row++) = 1 / constraint->Size(r);
    }
    largest = std::max(largest, point.rows);
    points_.push_back(std::move(point));
  }
  scaled_lambda_.resize(largest);
  row_rates_.resize(largest);
}

void IntervalBlock::BuildPath(const AddedConstraints& added) {
  IntervalPathRows::Locals locals;
  for (int source = 0; source < scheme_.sources(); ++source) locals.sources.push_back(SourceOffset(source));
  for (int i = 0; i < points_count_; ++i) locals.controls.push_back(ControlOffset(i));
  path_ = std::make_unique<IntervalPathRows>(problem_, added, phase_, scheme_, locals, scale_);
  rows_ += path_->size();
}

int IntervalBlock::SourceOffset(int source) const {
  const int n = layout_.n;
  if (source < 2) return source * n;
  if (source < 4) return local_size_ - 2 * n + (source - 2) * n;
  return 2 * n + (source - 4) * n;
}

void IntervalBlock::BuildJacobianPattern() {
  const int n = layout_.n;
  for (int i = 0; i < points_count_; ++i) {
    Point& point = points_[i];
    int row0 = 0;
    std::map<std::pair<int, int>, int> kinds;  // (row, coordinate) -> bit set of q, v, a
    for (PointConstraint* constraint : point.constraints) {
      for (const auto& [row, column] : constraint->JacobianPattern()) {
        if (column >= 3 * n) {
          point.control_entries.emplace_back(row0 + row, column);
        } else {
          kinds[{row0 + row, column % n}] |= 1 << (column / n);
        }
      }
      row0 += constraint->rows();
    }
    std::set<int> dense_rows;
    for (const auto& [where, bits] : kinds) {
      for (int source = 0; source < scheme_.sources(); ++source) {
        bool depends = false;
        for (Kind kind : EliminatedScheme::kKinds)
          depends |= ((bits >> kind) & 1) != 0 && scheme_.Depends(kind, i, source);
        if (depends) point.state_entries.push_back({where.first, where.second, source});
      }
      dense_rows.insert(where.first);
    }
    point.dense_rows.assign(dense_rows.begin(), dense_rows.end());
    for (const auto& e : point.state_entries) {
      jacobian_pattern_.emplace_back(point.first_row + e.row, SourceOffset(e.source) + e.coordinate);
    }
    for (const auto& [row, column] : point.control_entries) {
      jacobian_pattern_.emplace_back(point.first_row + row, ControlOffset(i) + column - 3 * n);
    }
    for (int row : point.dense_rows) jacobian_pattern_.emplace_back(point.first_row + row, local_size_);
  }
  for (const auto& [row, column] : path_->JacobianPattern(local_size_)) {
    jacobian_pattern_.emplace_back(FirstPathRow() + row, column);
  }
  for (size_t e = 0; e < jacobian_pattern_.size(); ++e) {
    if (jacobian_pattern_[e].second == local_size_) jacobian_step_entries_.push_back(static_cast<int>(e));
  }
}

// Local variables behind variable `column` of z at point i.
std::vector<int> IntervalBlock::Behind(int i, int column) const {
  const int n = layout_.n;
  if (column >= 3 * n) return {ControlOffset(i) + column - 3 * n};
  std::vector<int> locals;
  for (int source = 0; source < scheme_.sources(); ++source) {
    if (scheme_.Depends(static_cast<Kind>(column / n), i, source)) locals.push_back(SourceOffset(source) + column % n);
  }
  return locals;
}

// Pairs of variables of z with a second derivative at point i, and the variables of z that meet h: all that enter
// anything nonlinear.
void IntervalBlock::PointPairs(int i, Entries* pairs, std::set<int>* step_coupled) {
  const int n = layout_.n;
  for (PointConstraint* constraint : points_[i].constraints) {
    const Entries p = constraint->HessianPattern();
    pairs->insert(pairs->end(), p.begin(), p.end());
    for (const auto& [row, column] : constraint->JacobianPattern()) {
      if (column < 3 * n) step_coupled->insert(column);
    }
  }
  for (PointCost* integrand : costs_) {
    if (integrand == nullptr) continue;
    for (const auto& [a, b] : integrand->HessianPattern()) {
      pairs->emplace_back(a, b);
      step_coupled->insert({a, b});
    }
  }
  for (const auto& [a, b] : *pairs) {
    bends_accelerations_ |= a >= 2 * n && b >= 2 * n && a < 3 * n && b < 3 * n;
    if (a < 3 * n) step_coupled->insert(b);
    if (b < 3 * n) step_coupled->insert(a);
  }
}

void IntervalBlock::BuildHessianPattern() {
  const int order = local_size_ + 1;
  std::vector<char> lower(static_cast<size_t>(order) * order,
                          0);  // column by column, as the dense local matrix is stored
  std::set<int> cost;
  const auto add = [&](int a, int b) { lower[static_cast<size_t>(std::min(a, b)) * order + std::max(a, b)] = 1; };
  for (int i = 0; i < points_count_; ++i) {
    Entries pairs;
    std::set<int> step_coupled;
    PointPairs(i, &pairs, &step_coupled);
    for (const auto& [a, b] : pairs) {
      for (int x : Behind(i, a)) {
        for (int y : Behind(i, b)) add(x, y);
      }
    }
    for (int column : step_coupled) {
      for (int x : Behind(i, column)) add(local_size_, x);
    }
    for (PointCost* integrand : costs_) {
      if (integrand == nullptr) continue;
      for (const auto& [a, b] : integrand->HessianPattern()) {
        for (int column : {a, b}) {
          for (int local : Behind(i, column)) cost.insert(local);
        }
      }
    }
  }
  for (const auto& [a, b] : path_->HessianPairs(local_size_)) add(a, b);
  add(local_size_, local_size_);
  for (int column = 0; column < order; ++column) {
    for (int row = column; row < order; ++row) {
      if (lower[static_cast<size_t>(column) * order + row] != 0) hessian_pattern_.emplace_back(row, column);
    }
  }
  cost_variables_.assign(cost.begin(), cost.end());
  const auto scale = [this](int i) { return i < local_size_ ? scale_(i) : 1; };
  for (const auto& [i, j] : hessian_pattern_) {
    if (i == local_size_) hessian_step_entries_.push_back(static_cast<int>(hessian_place_.size()));
    hessian_place_.push_back(i + j * order);
    hessian_scale_.push_back(scale(i) * scale(j));
  }
}

void IntervalBlock::Bounds(double start, double length, const IntervalPlace& place, double* lower,
                           double* upper) const {
  for (int i = 0; i < points_count_; ++i) {
    const Point& point = points_[i];
    const double fraction = start + scheme_.tableau().c(i) * length;
    int row = point.first_row;
    for (PointConstraint* constraint : point.constraints) {
      constraint->Bounds(fraction, lower + row, upper + row);
      const bool free = place.last && i == points_count_ - 1 && constraint->FreeAtEndOfPhase();
      for (int r = 0; r < constraint->rows(); ++r, ++row) {
        if (free) lower[row] = -kInfinity;
        lower[row] /= constraint->Size(r);
        upper[row] /= constraint->Size(r);
      }
    }
  }
  path_->Bounds(place, lower + FirstPathRow(), upper + FirstPathRow());
}

IntervalBlock::RowInfo IntervalBlock::Describe(int row) const {
  for (int i = 0; i < points_count_; ++i) {
    int first = points_[i].first_row;
    for (PointConstraint* constraint : points_[i].constraints) {
      if (row < first + constraint->rows()) {
        const int r = row - first;
        return {constraint->Name(r), constraint->Unit(r), constraint->Size(r), i};
      }
      first += constraint->rows();
    }
  }
  const int r = row - FirstPathRow();
  ROLLGAIT_CHECK(r >= 0 && r < path_->size());
  return {path_->Name(r), path_->Unit(r), path_->Size(r), points_count_ - 1};
}

}  // namespace rollgait
