#include "core/transcription/interval_block.h"

#include <algorithm>

namespace rollgait {
namespace {

using Kind = EliminatedScheme::Kind;

}  // namespace

void IntervalBlock::SetStep(double h) {
  if (h == step_) return;
  step_ = h;
  for (Kind kind : EliminatedScheme::kKinds) {
    for (int i = 0; i < points_count_; ++i) {
      for (int s = 0; s < scheme_.sources(); ++s) {
        value_[kind](i, s) = scheme_.Value(kind, i, s, h);
        scaled_[kind](i, s) = value_[kind](i, s) * scale_(SourceOffset(s));
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
      if (!scheme_.Depends(EliminatedScheme::kKinds[kind], i, s)) continue;
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
  if (!points_[i].goes_on_rolling) return;
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

void IntervalBlock::Integrals(const double* y, double h, CostForm form, double* integrals) {
  SetStep(h);
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    for (size_t t = 0; t < costs_.size(); ++t) {
      if (costs_[t] == nullptr) continue;
      const double value = form == CostForm::kMinimised ? costs_[t]->Value(context_) : costs_[t]->Unsmoothed(context_);
      integrals[t] += h * scheme_.tableau().b(i) * value;
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
        if (value_[kind](i, s) == 0) continue;
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
    for (int r = 0; r < point.rows; ++r) g[point.first_row + r] *= point.row_factor(r);
  }
  path_->Values(y, h, g + FirstPathRow());
}

void IntervalBlock::EvaluateJacobian(Point* point) {
  int row = 0;
  for (PointConstraint* constraint : point->constraints) {
    constraint->Jacobian(context_, point->jacobian.middleRows(row, constraint->rows()));
    row += constraint->rows();
  }
}

double* IntervalBlock::WriteJacobian(int i, double* values) {
  const Point& point = points_[i];
  const int n = layout_.n;
  const double* j = point.jacobian.data();
  const Eigen::Index stride = point.jacobian.rows(), kind = stride * n;
  for (const auto& e : point.state_entries) {
    const double* entry = j + e.row + e.coordinate * stride;
    const double sum = scaled_[0](i, e.source) * entry[0] + scaled_[1](i, e.source) * entry[kind] +
                       scaled_[2](i, e.source) * entry[2 * kind];
    *values++ = sum * point.row_factor(e.row);
  }
  const int controls = ControlOffset(i) - 3 * n;
  for (const auto& [row, column] : point.control_entries) {
    *values++ = j[row + column * stride] * scale_(controls + column) * point.row_factor(row);
  }
  auto rates = row_rates_.head(point.rows);
  rates.setZero();
  for (int c = 0; c < 3 * n; ++c) rates += z_rate_(c) * point.jacobian.col(c);
  for (int row : point.dense_rows) *values++ = row_rates_(row) * point.row_factor(row);
  return values;
}

void IntervalBlock::Derivatives(const double* y, double h, const double* lambda, const double* weights,
                                double* jacobian, double* hessian, Eigen::Ref<VectorX> cost_gradient) {
  SetStep(h);
  if (hessian != nullptr) {
    ClearLocal();
    CostGradient(y, h, weights, cost_gradient);
  }
  for (int i = 0; i < points_count_; ++i) {
    LoadPoint(y, i);
    UpdateWorkspace(i, true, hessian != nullptr);
    EvaluateJacobian(&points_[i]);
    if (jacobian != nullptr) jacobian = WriteJacobian(i, jacobian);
    if (hessian != nullptr) EvaluateHessian(i, h, lambda, weights);
  }
  if (jacobian != nullptr) path_->Jacobian(y, h, jacobian);
  if (hessian == nullptr) return;
  path_->AddHessian(y, h, lambda + FirstPathRow(), local_);
  for (size_t e = 0; e < hessian_place_.size(); ++e) hessian[e] = local_.data()[hessian_place_[e]] * hessian_scale_[e];
}

// Its lower triangle, and the other half of the blocks on the diagonal, which are written whole.
void IntervalBlock::ClearLocal() {
  const int widest = std::max(layout_.n, controls_), order = local_size_ + 1;
  for (int column = 0; column < order; ++column) {
    double* values = local_.data() + static_cast<Eigen::Index>(column) * order;
    std::fill(values + std::max(0, column - widest), values + order, 0.0);
  }
}

// Adds point i to local_.
void IntervalBlock::EvaluateHessian(int i, double h, const double* lambda, const double* weights) {
  const int n = layout_.n;
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
  for (int r = 0; r < point.rows; ++r) scaled_lambda_(r) = lambda[point.first_row + r] * point.row_factor(r);
  int row = 0;
  for (PointConstraint* constraint : point.constraints) {
    constraint->AddHessian(context_, scaled_lambda_.data() + row, hessian_);
    row += constraint->rows();
  }
  gradient_.noalias() = point.jacobian.transpose() * scaled_lambda_.head(point.rows);
  gradient_ += h * cost_gradient_;
  AccumulateHessian(i);
  // Product rule of h · l(z(h)).
  for (int s = 0; s < scheme_.sources(); ++s) {
    for (int kind = 0; kind < 3; ++kind) {
      if (value_[kind](i, s) == 0) continue;
      local_.row(local_size_).segment(SourceOffset(s), n) +=
          value_[kind](i, s) * cost_gradient_.segment(kind * n, n).transpose();
    }
  }
  local_.row(local_size_).segment(ControlOffset(i), controls_) += cost_gradient_.tail(controls_).transpose();
  local_(local_size_, local_size_) += 2 * cost_gradient_.head(3 * n).dot(z_rate_);
}

// Carries the Hessian and gradient of the point through z(y, h) into local_, unscaled.
void IntervalBlock::AccumulateHessian(int i) {
  const int n = layout_.n, q = 0, v = n, u = 3 * n;
  AccumulateStates(i);
  if (bends_accelerations_) AccumulateAccelerations(i);
  const int control = ControlOffset(i);
  for (int s = 0; s < scheme_.sources(); ++s) {
    const double sq = value_[0](i, s), sv = value_[1](i, s);
    if (sq == 0 && sv == 0) continue;
    const int row = SourceOffset(s);
    block_.noalias() = sq * hessian_.block(q, u, n, controls_) + sv * hessian_.block(v, u, n, controls_);
    if (control > row) {
      local_.block(control, row, controls_, n) += block_.transpose();
    } else {
      local_.block(row, control, n, controls_) += block_;
    }
  }
  local_.block(control, control, controls_, controls_) += hessian_.block(u, u, controls_, controls_);
  AccumulateStep(i);
}

// Node states and free accelerations against each other.
void IntervalBlock::AccumulateStates(int i) {
  const int n = layout_.n, v = n, a = 2 * n;
  qq_ = hessian_.block(0, 0, n, n);
  vv_ = hessian_.block(v, v, n, n);
  qv_ = hessian_.block(0, v, n, n);
  qa_ = hessian_.block(0, a, n, n);
  vq_ = qv_.transpose();
  aq_ = qa_.transpose();
  const Eigen::Index stride = local_.rows();
  for (int s = 0; s < scheme_.sources(); ++s) {
    const double sq = value_[0](i, s), sv = value_[1](i, s), sa = value_[2](i, s);
    for (int t = 0; t < scheme_.sources(); ++t) {
      if (SourceOffset(t) > SourceOffset(s)) continue;
      const double tq = value_[0](i, t), tv = value_[1](i, t), ta = value_[2](i, t);
      const double c[] = {sq * tq, sv * tv, sq * tv, sv * tq, sq * ta, sa * tq};
      if (std::none_of(c, c + 6, [](double x) { return x != 0; })) continue;
      for (int column = 0; column < n; ++column) {
        double* target = local_.data() + SourceOffset(s) + (SourceOffset(t) + column) * stride;
        const Eigen::Index at = static_cast<Eigen::Index>(column) * n;
        const double *h0 = qq_.data() + at, *h1 = vv_.data() + at, *h2 = qv_.data() + at, *h3 = vq_.data() + at,
                     *h4 = qa_.data() + at, *h5 = aq_.data() + at;
        for (int r = 0; r < n; ++r) {
          target[r] += c[0] * h0[r] + c[1] * h1[r] + c[2] * h2[r] + c[3] * h3[r] + c[4] * h4[r] + c[5] * h5[r];
        }
      }
    }
  }
}

void IntervalBlock::AccumulateAccelerations(int i) {
  const int n = layout_.n, a = 2 * n;
  aa_ = hessian_.block(a, a, n, n);
  for (int s = 0; s < scheme_.sources(); ++s) {
    for (int t = 0; t < scheme_.sources(); ++t) {
      const double factor = value_[2](i, s) * value_[2](i, t);
      if (SourceOffset(t) > SourceOffset(s) || factor == 0) continue;
      local_.block(SourceOffset(s), SourceOffset(t), n, n) += factor * aa_;
    }
  }
}

// Everything against h: H ż with the symmetric Hessian of (q, v, a), and the gradient times the derivatives of the
// coefficients.
void IntervalBlock::AccumulateStep(int i) {
  const int n = layout_.n, q = 0, v = n, a = 2 * n, u = 3 * n;
  const auto rate_q = z_rate_.segment(q, n), rate_v = z_rate_.segment(v, n), rate_a = z_rate_.segment(a, n);
  turned_.segment(q, n).noalias() = qq_ * rate_q + qv_ * rate_v + qa_ * rate_a;
  turned_.segment(v, n).noalias() = vq_ * rate_q + vv_ * rate_v;
  turned_.segment(a, n).noalias() = aq_ * rate_q;
  if (bends_accelerations_) turned_.segment(a, n).noalias() += aa_ * rate_a;
  auto step_row = local_.row(local_size_);
  for (int s = 0; s < scheme_.sources(); ++s) {
    for (int kind = 0; kind < 3; ++kind) {
      if (!scheme_.Depends(EliminatedScheme::kKinds[kind], i, s)) continue;
      step_row.segment(SourceOffset(s), n) += value_[kind](i, s) * turned_.segment(kind * n, n).transpose() +
                                              first_[kind](i, s) * gradient_.segment(kind * n, n).transpose();
    }
  }
  step_controls_.noalias() = hessian_.block(q, u, n, controls_).transpose() * rate_q;
  step_controls_.noalias() += hessian_.block(v, u, n, controls_).transpose() * rate_v;
  step_row.segment(ControlOffset(i), controls_) += step_controls_.transpose();
  local_(local_size_, local_size_) += turned_.dot(z_rate_) + gradient_.head(3 * n).dot(z_curve_);
}

}  // namespace rollgait
