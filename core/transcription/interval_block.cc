#include "core/transcription/interval_block.h"

namespace rollgait {
namespace {

using Kind = EliminatedScheme::Kind;
constexpr Kind kKinds[] = {EliminatedScheme::kPosition, EliminatedScheme::kVelocity, EliminatedScheme::kAcceleration};

}  // namespace

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
  for (auto& contact : workspace_->contacts) {
    contact.Update(workspace_->tree);
    if (second) contact.UpdateSecond();
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
    for (size_t t = 0; t < costs_.size(); ++t) {
      if (costs_[t] != nullptr) integrals[t] += h * scheme_.tableau().b(i) * costs_[t]->Value(context_);
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
    for (size_t t = 0; t < costs_.size(); ++t) {
      PointCost* integrand = costs_[t];
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
    for (size_t t = 0; t < costs_.size(); ++t) {
      PointCost* integrand = costs_[t];
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
  step_controls_.noalias() = hessian_.block(q, u, n, controls_).transpose() * rate_q;
  step_controls_.noalias() += hessian_.block(v, u, n, controls_).transpose() * rate_v;
  step_row.segment(control, controls_) += step_controls_.transpose();
  local_(local_size_, local_size_) += turned_.dot(z_rate_) + gradient_.head(3 * n).dot(z_curve_);
}

}  // namespace rollgait
