#include "core/transcription/tracking_term.h"

namespace rollgait {

TrackingTerm::TrackingTerm(const TrackingCost& cost, const DecisionLayout& layout, const EliminatedScheme& scheme)
    : cost_(cost), layout_(layout), scheme_(scheme), sources_(scheme.sources()), durations_(layout.phases()) {
  phase_start_.assign(durations_ + 1, 0.0);
  value_ = first_ = second_ = MatrixX::Zero(scheme.points(), sources_);
  theta_rate_ = VectorX::Zero(durations_);
  slope_ = VectorX::Zero(sources_ + durations_);
  local_ = MatrixX::Zero(sources_ + durations_, sources_ + durations_);
  duration_hessian_ = MatrixX::Zero(durations_, durations_);
  std::vector<int> unknowns;
  for (int k = 0; k < layout.intervals(); ++k) {
    for (const TrackingCost::Channel& channel : cost.channels) {
      for (int a = 0; a < sources_; ++a) {
        const int unknown = layout.source(k, a) + channel.joint;
        unknowns.push_back(unknown);
        for (int b = 0; b <= a; ++b) AddPair(unknown, layout.source(k, b) + channel.joint);
        for (int r = 0; r < durations_; ++r) AddPair(layout.duration(r), unknown);
      }
    }
  }
  for (int r = 0; r < durations_; ++r) {
    for (int u = 0; u <= r; ++u) AddPair(layout.duration(r), layout.duration(u));
  }
  SetUnknowns(std::move(unknowns));
}

void TrackingTerm::SetTimes(const double* x) {
  for (int p = 0; p < durations_; ++p) phase_start_[p + 1] = phase_start_[p] + x[layout_.duration(p)];
}

void TrackingTerm::SetStep(double h) {
  if (h == step_) return;
  step_ = h;
  for (int i = 0; i < scheme_.points(); ++i) {
    for (int s = 0; s < sources_; ++s) {
      const double unit = DecisionLayout::source_scale(s);
      value_(i, s) = unit * scheme_.Value(EliminatedScheme::kPosition, i, s, h);
      first_(i, s) = unit * scheme_.First(EliminatedScheme::kPosition, i, s, h);
      second_(i, s) = unit * scheme_.Second(EliminatedScheme::kPosition, i, s, h);
    }
  }
}

void TrackingTerm::SetPoint(const double* x, int interval, int point) {
  interval_ = interval;
  point_ = point;
  phase_ = layout_.phase(interval);
  length_ = layout_.length(interval);
  h_ = length_ * x[layout_.duration(phase_)];
  SetStep(h_);
  quadrature_ = scheme_.tableau().b(point);
  const double fraction = layout_.start(interval) + scheme_.tableau().c(point) * length_;
  const double total = phase_start_[durations_];
  theta_ = (phase_start_[phase_] + fraction * x[layout_.duration(phase_)]) / total;
  for (int r = 0; r < durations_; ++r) {
    const double share = r < phase_ ? 1 : (r == phase_ ? fraction : 0);
    theta_rate_(r) = (share - theta_) / total;
  }
}

TrackingTerm::Residual TrackingTerm::Evaluate(const double* x, const TrackingCost::Channel& channel) {
  double q = 0, q_h = 0, q_hh = 0;
  for (int s = 0; s < sources_; ++s) {
    const double unknown = x[layout_.source(interval_, s) + channel.joint];
    q += value_(point_, s) * unknown;
    q_h += first_(point_, s) * unknown;
    q_hh += second_(point_, s) * unknown;
  }
  return {q - channel.reference.Value(theta_), q_h, q_hh, channel.reference.First(theta_),
          channel.reference.Second(theta_)};
}

void TrackingTerm::SetSlope(const Residual& residual) {
  slope_.head(sources_) = value_.row(point_).transpose();
  slope_.tail(durations_) = -residual.r_t * theta_rate_;
  slope_(sources_ + phase_) += length_ * residual.q_h;
}

double TrackingTerm::Integral(const double* x) {
  SetTimes(x);
  double sum = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (int i = 0; i < scheme_.points(); ++i) {
      SetPoint(x, k, i);
      for (const TrackingCost::Channel& channel : cost_.channels) {
        const double e = Evaluate(x, channel).e;
        sum += channel.weight * quadrature_ * h_ * e * e;
      }
    }
  }
  return sum;
}

void TrackingTerm::AddGradient(const double* x, double factor, double* gradient) {
  SetTimes(x);
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (int i = 0; i < scheme_.points(); ++i) {
      SetPoint(x, k, i);
      for (const TrackingCost::Channel& channel : cost_.channels) {
        const Residual residual = Evaluate(x, channel);
        SetSlope(residual);
        const double weight = factor * channel.weight * quadrature_;
        for (int s = 0; s < sources_; ++s) {
          gradient[layout_.source(k, s) + channel.joint] += 2 * weight * h_ * residual.e * slope_(s);
        }
        for (int r = 0; r < durations_; ++r) {
          gradient[layout_.duration(r)] += 2 * weight * h_ * residual.e * slope_(sources_ + r);
        }
        gradient[layout_.duration(phase_)] += weight * length_ * residual.e * residual.e;
      }
    }
  }
}

// Adds factor · ∂²(h e²) by sources and durations, with h = length · T_phase and e = q(sources, h) − r(θ).
void TrackingTerm::AddLocalHessian(const Residual& residual, double factor) {
  SetSlope(residual);
  const double e = residual.e, total = phase_start_[durations_];
  const int own = sources_ + phase_;
  for (int b = 0; b < sources_ + durations_; ++b) {
    for (int a = b; a < sources_ + durations_; ++a) local_(a, b) += factor * 2 * h_ * slope_(a) * slope_(b);
  }
  for (int s = 0; s < sources_; ++s) {
    local_(own, s) += factor * 2 * length_ * e * (h_ * first_(point_, s) + slope_(s));
  }
  for (int u = 0; u < durations_; ++u) {
    for (int r = u; r < durations_; ++r) {
      const double bend =
          residual.r_tt * theta_rate_(r) * theta_rate_(u) - residual.r_t * (theta_rate_(r) + theta_rate_(u)) / total;
      double entry = -h_ * bend;
      if (r == phase_) entry += length_ * slope_(sources_ + u);
      if (u == phase_) entry += length_ * slope_(sources_ + r);
      local_(sources_ + r, sources_ + u) += factor * 2 * e * entry;
    }
  }
  local_(own, own) += factor * 2 * e * h_ * length_ * length_ * residual.q_hh;
}

void TrackingTerm::Hessian(const double* x, double factor, double* values) {
  SetTimes(x);
  duration_hessian_.setZero();
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (const TrackingCost::Channel& channel : cost_.channels) {
      local_.setZero();
      for (int i = 0; i < scheme_.points(); ++i) {
        SetPoint(x, k, i);
        AddLocalHessian(Evaluate(x, channel), factor * channel.weight * quadrature_);
      }
      for (int a = 0; a < sources_; ++a) {
        for (int b = 0; b <= a; ++b) *values++ = local_(a, b);
        for (int r = 0; r < durations_; ++r) *values++ = local_(sources_ + r, a);
      }
      duration_hessian_ += local_.bottomRightCorner(durations_, durations_);
    }
  }
  for (int r = 0; r < durations_; ++r) {
    for (int u = 0; u <= r; ++u) *values++ = duration_hessian_(r, u);
  }
}

}  // namespace rollgait
