#include "core/transcription/interval_block.h"

#include <algorithm>
#include <map>
#include <set>

namespace rollgait {
namespace {

using Kind = EliminatedScheme::Kind;
constexpr Kind kKinds[] = {EliminatedScheme::kPosition, EliminatedScheme::kVelocity, EliminatedScheme::kAcceleration};
constexpr double kAccelerationScale = 10;  // m/s², rad/s²

}  // namespace

PointWorkspace::PointWorkspace(const OptimalControlProblem& problem, bool with_dual) : tree(problem.model) {
  for (const ContactSurface& contact : problem.contacts) {
    contacts.emplace_back(problem.model, contact);
    if (with_dual) dual_contacts.emplace_back(problem.model, contact);
  }
}

IntervalBlock::IntervalBlock(const OptimalControlProblem& problem, int phase, const EliminatedScheme& scheme,
                             PointWorkspace* workspace)
    : problem_(problem),
      scheme_(scheme),
      workspace_(workspace),
      layout_(problem.Layout(phase)),
      points_count_(scheme.points()),
      controls_(layout_.efforts + layout_.forces),
      regular_(problem.PointConstraints(phase, false)),
      active_contacts_(problem.phases[phase].active) {
  if (scheme.tableau().starts_at_node()) at_node_ = problem.PointConstraints(phase, true);
  for (int c = 0; c < static_cast<int>(problem.contacts.size()); ++c) used_contacts_.push_back(c);
  local_size_ = 4 * layout_.n + (points_count_ - 2) * layout_.n + points_count_ * controls_;
  scale_ = VectorX::Ones(local_size_);
  scale_.segment(2 * layout_.n, (points_count_ - 2) * layout_.n).setConstant(kAccelerationScale);
  for (int i = 0; i < points_count_; ++i) {
    scale_.segment(ControlOffset(i), layout_.efforts).setConstant(problem.effort_size());
    scale_.segment(ControlOffset(i) + layout_.efforts, layout_.forces).setConstant(problem.force_size());
  }
  for (auto* m : {value_, first_, second_}) {
    for (int k = 0; k < 3; ++k) m[k] = MatrixX::Zero(points_count_, scheme.sources());
  }
  context_.tree = &workspace->tree;
  context_.contacts = &workspace->contacts;
  context_.dual_contacts = &workspace->dual_contacts;
  z_ = VectorX::Zero(layout_.size());
  context_.z = z_.data();
  z_rate_ = z_curve_ = VectorX::Zero(3 * layout_.n);
  hessian_ = MatrixX::Zero(layout_.size(), layout_.size());
  gradient_ = cost_gradient_ = VectorX::Zero(layout_.size());
  local_ = MatrixX::Zero(local_size_ + 1, local_size_ + 1);
  block_ = MatrixX::Zero(layout_.n, controls_);
  turned_ = VectorX::Zero(3 * layout_.n);
  BuildPoints();
  BuildJacobianPattern();
  BuildHessianPattern();
}

void IntervalBlock::BuildPoints() {
  int largest = 0;
  for (int i = 0; i < points_count_; ++i) {
    Point point;
    point.at_node = i == 0 && !at_node_.empty();
    for (const auto& constraint : point.at_node ? at_node_ : regular_) {
      point.constraints.push_back(constraint.get());
      point.rows += constraint->rows();
    }
    point.first_row = rows_;
    rows_ += point.rows;
    point.row_size.resize(point.rows);
    int row = 0;
    for (PointConstraint* constraint : point.constraints) {
      for (int r = 0; r < constraint->rows(); ++r) point.row_size(row++) = constraint->Size(r);
    }
    largest = std::max(largest, point.rows);
    points_.push_back(std::move(point));
  }
  jacobian_ = MatrixX::Zero(largest, layout_.size());
  scaled_lambda_.resize(largest);
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
        for (Kind kind : kKinds) depends |= ((bits >> kind) & 1) != 0 && scheme_.Depends(kind, i, source);
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
}

void IntervalBlock::BuildHessianPattern() {
  const int n = layout_.n;
  std::set<std::pair<int, int>> lower;
  std::set<int> cost;
  const auto add = [&lower](int a, int b) { lower.emplace(std::max(a, b), std::min(a, b)); };
  // Local variables behind variable `column` of z at point i.
  const auto behind = [&](int i, int column) {
    std::vector<int> locals;
    if (column >= 3 * n) return std::vector<int>{ControlOffset(i) + column - 3 * n};
    for (int source = 0; source < scheme_.sources(); ++source) {
      if (scheme_.Depends(static_cast<Kind>(column / n), i, source)) locals.push_back(SourceOffset(source) + column % n);
    }
    return locals;
  };
  for (int i = 0; i < points_count_; ++i) {
    Entries pairs;
    std::set<int> step_coupled;  // variables of z that meet h: all that enter anything nonlinear
    for (PointConstraint* constraint : points_[i].constraints) {
      const Entries p = constraint->HessianPattern();
      pairs.insert(pairs.end(), p.begin(), p.end());
      for (const auto& [row, column] : constraint->JacobianPattern()) {
        if (column < 3 * n) step_coupled.insert(column);
      }
    }
    for (const CostDescription& term : problem_.costs) {
      if (!term.integrand) continue;
      for (const auto& [a, b] : term.integrand->HessianPattern()) {
        pairs.emplace_back(a, b);
        for (int column : {a, b}) {
          step_coupled.insert(column);
          for (int local : behind(i, column)) cost.insert(local);
        }
      }
    }
    for (const auto& [a, b] : pairs) {
      for (int x : behind(i, a)) {
        for (int y : behind(i, b)) add(x, y);
      }
      if (a < 3 * n) step_coupled.insert(b);
      if (b < 3 * n) step_coupled.insert(a);
    }
    for (int column : step_coupled) {
      for (int x : behind(i, column)) add(local_size_, x);
    }
  }
  add(local_size_, local_size_);
  hessian_pattern_.assign(lower.begin(), lower.end());
  // Column by column, as the dense local matrix is stored.
  std::sort(hessian_pattern_.begin(), hessian_pattern_.end(),
            [](const auto& a, const auto& b) { return std::pair(a.second, a.first) < std::pair(b.second, b.first); });
  cost_variables_.assign(cost.begin(), cost.end());
}

void IntervalBlock::Bounds(double start, double length, bool last, double* lower, double* upper) const {
  for (int i = 0; i < points_count_; ++i) {
    const Point& point = points_[i];
    const double fraction = start + scheme_.tableau().c(i) * length;
    int row = point.first_row;
    for (PointConstraint* constraint : point.constraints) {
      constraint->Bounds(fraction, lower + row, upper + row);
      // A gap at the end of its phase is the business of the next phase: touch-down fixes it.
      const bool end_of_phase = last && i == points_count_ - 1;
      for (int r = 0; r < constraint->rows(); ++r, ++row) {
        if (end_of_phase && constraint->Unit(r) == "m") lower[row] = -kInfinity;
        lower[row] /= constraint->Size(r);
        upper[row] /= constraint->Size(r);
      }
    }
  }
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
  ROLLGAIT_CHECK(false);
}

void IntervalBlock::SetStep(double h) {
  if (h == step_) return;
  step_ = h;
  for (Kind kind : kKinds) {
    for (int i = 0; i < points_count_; ++i) {
      for (int s = 0; s < scheme_.sources(); ++s) {
        value_[kind](i, s) = scheme_.Value(kind, i, s, h);
        first_[kind](i, s) = scheme_.First(kind, i, s, h);
        second_[kind](i, s) = scheme_.Second(kind, i, s, h);
      }
    }
  }
}

void IntervalBlock::LoadPoint(const double* y, int i) {
  const int n = layout_.n;
  z_.head(3 * n).setZero();
  z_rate_.setZero();
  z_curve_.setZero();
  for (int s = 0; s < scheme_.sources(); ++s) {
    const int offset = SourceOffset(s);
    const Eigen::Map<const VectorX> unknown(y + offset, n);
    const double scale = scale_(offset);
    for (int kind = 0; kind < 3; ++kind) {
      if (!scheme_.Depends(kKinds[kind], i, s)) continue;
      z_.segment(kind * n, n) += scale * value_[kind](i, s) * unknown;
      z_rate_.segment(kind * n, n) += scale * first_[kind](i, s) * unknown;
      z_curve_.segment(kind * n, n) += scale * second_[kind](i, s) * unknown;
    }
  }
  for (int j = 0; j < controls_; ++j) {
    z_(3 * n + j) = y[ControlOffset(i) + j] * scale_(ControlOffset(i) + j);
  }
}

void IntervalBlock::UpdateWorkspace(int i, bool dynamics, bool second) {
  const int n = layout_.n;
  if (dynamics) {
    workspace_->tree.Update(z_.data(), z_.data() + n, z_.data() + 2 * n, problem_.gravity);
  } else {
    workspace_->tree.UpdateKinematics(z_.data(), z_.data() + n);
  }
  for (int c : used_contacts_) {
    workspace_->contacts[c].Update(workspace_->tree);
    if (second) workspace_->contacts[c].UpdateSecond();
  }
  if (!points_[i].at_node) return;
  for (int c : active_contacts_) {
    workspace_->dual_contacts[c].Update(workspace_->tree);
    if (second) workspace_->dual_contacts[c].UpdateSecond();
  }
}

const VectorX& IntervalBlock::PointState(const double* y, double h, int i) {
  SetStep(h);
  LoadPoint(y, i);
  return z_;
}

void IntervalBlock::Integrals(const double* y, double h, double* integrals) {
  SetStep(h);
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    for (size_t t = 0; t < problem_.costs.size(); ++t) {
      PointCost* integrand = problem_.costs[t].integrand.get();
      if (integrand != nullptr) integrals[t] += h * scheme_.tableau().b(i) * integrand->Value(context_);
    }
  }
}

void IntervalBlock::CostGradient(const double* y, double h, const double* weights, Eigen::Ref<VectorX> gradient) {
  const int n = layout_.n;
  SetStep(h);
  gradient.setZero();
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    cost_gradient_.setZero();
    const double b = scheme_.tableau().b(i);
    for (size_t t = 0; t < problem_.costs.size(); ++t) {
      PointCost* integrand = problem_.costs[t].integrand.get();
      if (integrand == nullptr) continue;
      gradient(local_size_) += weights[t] * b * integrand->Value(context_);
      integrand->AddGradient(context_, weights[t] * h * b, cost_gradient_);
    }
    for (int s = 0; s < scheme_.sources(); ++s) {
      const int offset = SourceOffset(s);
      for (int kind = 0; kind < 3; ++kind) {
        gradient.segment(offset, n) += scale_(offset) * value_[kind](i, s) * cost_gradient_.segment(kind * n, n);
      }
    }
    gradient.segment(ControlOffset(i), controls_) +=
        scale_.segment(ControlOffset(i), controls_).cwiseProduct(cost_gradient_.tail(controls_));
    gradient(local_size_) += cost_gradient_.head(3 * n).dot(z_rate_);
  }
}

void IntervalBlock::Values(const double* y, double h, double* g) {
  SetStep(h);
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    UpdateWorkspace(i, true, false);
    const Point& point = points_[i];
    double* out = g + point.first_row;
    for (PointConstraint* constraint : point.constraints) {
      constraint->Value(context_, out);
      out += constraint->rows();
    }
    for (int r = 0; r < point.rows; ++r) g[point.first_row + r] /= point.row_size(r);
  }
}

void IntervalBlock::EvaluateJacobian(int i) {
  int row = 0;
  for (PointConstraint* constraint : points_[i].constraints) {
    // Entries outside a row's pattern stay zero from one point kind to the other: rows are the same objects' rows only
    // within one kind, so clear what another kind may have left.
    jacobian_.middleRows(row, constraint->rows()).setZero();
    constraint->Jacobian(context_, jacobian_.middleRows(row, constraint->rows()));
    row += constraint->rows();
  }
}

void IntervalBlock::Jacobian(const double* y, double h, double* values) {
  const int n = layout_.n;
  SetStep(h);
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    UpdateWorkspace(i, true, false);
    EvaluateJacobian(i);
    const Point& point = points_[i];
    for (const auto& e : point.state_entries) {
      const double sum = value_[0](i, e.source) * jacobian_(e.row, e.coordinate) +
                         value_[1](i, e.source) * jacobian_(e.row, n + e.coordinate) +
                         value_[2](i, e.source) * jacobian_(e.row, 2 * n + e.coordinate);
      *values++ = sum * scale_(SourceOffset(e.source)) / point.row_size(e.row);
    }
    for (const auto& [row, column] : point.control_entries) {
      *values++ = jacobian_(row, column) * scale_(ControlOffset(i) + column - 3 * n) / point.row_size(row);
    }
    for (int row : point.dense_rows) {
      *values++ = jacobian_.row(row).head(3 * n).dot(z_rate_) / point.row_size(row);
    }
  }
}

void IntervalBlock::Hessian(const double* y, double h, const double* lambda, const double* weights, double* values,
                            Eigen::Ref<VectorX> cost_gradient) {
  const int n = layout_.n;
  SetStep(h);
  local_.setZero();
  CostGradient(y, h, weights, cost_gradient);
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    UpdateWorkspace(i, true, true);
    EvaluateJacobian(i);
    const Point& point = points_[i];
    const double b = scheme_.tableau().b(i);
    hessian_.setZero();
    cost_gradient_.setZero();
    for (size_t t = 0; t < problem_.costs.size(); ++t) {
      PointCost* integrand = problem_.costs[t].integrand.get();
      if (integrand == nullptr) continue;
      integrand->AddGradient(context_, weights[t] * b, cost_gradient_);  // without the factor h
      integrand->AddHessian(context_, weights[t] * h * b, hessian_);
    }
    for (int r = 0; r < point.rows; ++r) scaled_lambda_(r) = lambda[point.first_row + r] / point.row_size(r);
    int row = 0;
    for (PointConstraint* constraint : point.constraints) {
      constraint->AddHessian(context_, scaled_lambda_.data() + row, hessian_);
      row += constraint->rows();
    }
    gradient_.noalias() = jacobian_.topRows(point.rows).transpose() * scaled_lambda_.head(point.rows);
    gradient_ += h * cost_gradient_;
    AccumulateHessian(i);
    // Product rule of h · l(z(h)).
    for (int s = 0; s < scheme_.sources(); ++s) {
      for (int kind = 0; kind < 3; ++kind) {
        local_.row(local_size_).segment(SourceOffset(s), n) +=
            value_[kind](i, s) * cost_gradient_.segment(kind * n, n).transpose();
      }
    }
    local_.row(local_size_).segment(ControlOffset(i), controls_) += cost_gradient_.tail(controls_).transpose();
    local_(local_size_, local_size_) += 2 * cost_gradient_.head(3 * n).dot(z_rate_);
  }
  for (const auto& [i, j] : hessian_pattern_) {
    const double row_scale = i < local_size_ ? scale_(i) : 1;
    const double column_scale = j < local_size_ ? scale_(j) : 1;
    *values++ = local_(i, j) * row_scale * column_scale;
  }
}

// Carries the Hessian and gradient of the point through z(y, h) into local_, unscaled.
void IntervalBlock::AccumulateHessian(int i) {
  const int n = layout_.n, q = 0, v = n, a = 2 * n, u = 3 * n;
  const auto H = [this, n](int row, int column) { return hessian_.block(row, column, n, n); };
  for (int s = 0; s < scheme_.sources(); ++s) {
    const double sq = value_[0](i, s), sv = value_[1](i, s), sa = value_[2](i, s);
    const int row = SourceOffset(s);
    for (int t = 0; t < scheme_.sources(); ++t) {
      const int column = SourceOffset(t);
      if (column > row) continue;
      const double tq = value_[0](i, t), tv = value_[1](i, t), ta = value_[2](i, t);
      if (sq == 0 && sv == 0 && sa == 0) continue;
      if (tq == 0 && tv == 0 && ta == 0) continue;
      local_.block(row, column, n, n) += (sq * tq) * H(q, q) + (sv * tv) * H(v, v) + (sq * tv) * H(q, v) +
                                         (sv * tq) * H(q, v).transpose() + (sq * ta) * H(q, a) +
                                         (sa * tq) * H(q, a).transpose();
    }
    // Against the controls of the point.
    const int control = ControlOffset(i);
    block_.noalias() = sq * hessian_.block(q, u, n, controls_) + sv * hessian_.block(v, u, n, controls_);
    if (control > row) {
      local_.block(control, row, controls_, n) += block_.transpose();
    } else {
      local_.block(row, control, n, controls_) += block_;
    }
  }
  const int control = ControlOffset(i);
  local_.block(control, control, controls_, controls_) += hessian_.block(u, u, controls_, controls_);
  // H ż with the symmetric Hessian of (q, v, a).
  const auto rate_q = z_rate_.segment(q, n), rate_v = z_rate_.segment(v, n), rate_a = z_rate_.segment(a, n);
  turned_.segment(q, n).noalias() = H(q, q) * rate_q + H(q, v) * rate_v + H(q, a) * rate_a;
  turned_.segment(v, n).noalias() = H(q, v).transpose() * rate_q + H(v, v) * rate_v;
  turned_.segment(a, n).noalias() = H(q, a).transpose() * rate_q;
  auto step_row = local_.row(local_size_);
  for (int s = 0; s < scheme_.sources(); ++s) {
    for (int kind = 0; kind < 3; ++kind) {
      step_row.segment(SourceOffset(s), n) += value_[kind](i, s) * turned_.segment(kind * n, n).transpose() +
                                              first_[kind](i, s) * gradient_.segment(kind * n, n).transpose();
    }
  }
  step_row.segment(control, controls_) += rate_q.transpose() * hessian_.block(q, u, n, controls_) +
                                          rate_v.transpose() * hessian_.block(v, u, n, controls_);
  local_(local_size_, local_size_) += turned_.dot(z_rate_) + gradient_.head(3 * n).dot(z_curve_);
}

}  // namespace rollgait
