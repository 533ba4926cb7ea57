#include "core/nlp/barrier_problem.h"

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

constexpr double kNoBound = 1e19;
constexpr double kDamping = 1e-5;

double Relaxed(double bound, double by) {
  if (std::abs(bound) >= kNoBound) return bound > 0 ? kInfinity : -kInfinity;
  return bound + by * std::max(1.0, std::abs(bound));
}

}  // namespace

BarrierProblem::BarrierProblem(NlpProblem& problem, double relaxation)
    : problem_(problem), n_(problem.variables()), m_(problem.constraints()), target_(VectorX::Zero(m_)), fixed_(n_, 0) {
  for (int r = 0; r < m_; ++r) {
    const double lower = problem.constraint_lower()(r), upper = problem.constraint_upper()(r);
    if (lower == upper) {
      target_(r) = lower;
    } else if (lower <= -kNoBound && upper >= kNoBound) {
      free_rows_.push_back(r);
    } else {
      slack_rows_.push_back(r);
    }
  }
  const int size = n_ + static_cast<int>(slack_rows_.size());
  lower_.resize(size);
  upper_.resize(size);
  for (int i = 0; i < size; ++i) {
    const double lower = i < n_ ? problem.lower_bounds()(i) : problem.constraint_lower()(slack_rows_[i - n_]);
    const double upper = i < n_ ? problem.upper_bounds()(i) : problem.constraint_upper()(slack_rows_[i - n_]);
    if (i < n_ && lower == upper) {
      fixed_[i] = 1;
      lower_(i) = -kInfinity;
      upper_(i) = kInfinity;
      continue;
    }
    lower_(i) = Relaxed(lower, -relaxation);
    upper_(i) = Relaxed(upper, relaxation);
  }
  moved_.assign(static_cast<size_t>(size), 0);
}

double BarrierProblem::Inside(double value, int i, double push) const {
  const double width = upper_(i) - lower_(i), size = i < n_ ? problem_.variable_size(i) : 1;
  if (has_lower(i)) {
    const double margin = std::min(push * std::max(size, std::abs(lower_(i))), push * width);
    value = std::max(value, lower_(i) + margin);
  }
  if (has_upper(i)) {
    const double margin = std::min(push * std::max(size, std::abs(upper_(i))), push * width);
    value = std::min(value, upper_(i) - margin);
  }
  return value;
}

bool BarrierProblem::MakeInterior(const VectorX& x, double push, Point* point) {
  point->w = VectorX::Zero(unknowns());
  point->c = VectorX::Zero(m_);
  for (int i = 0; i < n_; ++i) point->w(i) = fixed(i) ? problem_.lower_bounds()(i) : Inside(x(i), i, push);
  if (!problem_.Constraints(point->w.data(), point->c.data())) return false;
  for (size_t k = 0; k < slack_rows_.size(); ++k) {
    const int i = n_ + static_cast<int>(k);
    point->w(i) = Inside(point->c(slack_rows_[k]), i, push);
  }
  return Evaluate(point);
}

bool BarrierProblem::Evaluate(Point* point) {
  if (!problem_.Constraints(point->w.data(), point->c.data())) return false;
  if (!problem_.Objective(point->w.data(), &point->f)) return false;
  point->c -= target_;
  for (size_t k = 0; k < slack_rows_.size(); ++k) point->c(slack_rows_[k]) -= point->w(n_ + static_cast<int>(k));
  for (const int r : free_rows_) point->c(r) = 0;
  point->theta = point->c.lpNorm<1>();
  return std::isfinite(point->theta);
}

bool BarrierProblem::Gradient(const Point& point, VectorX* gradient) {
  return problem_.Gradient(point.w.data(), gradient->data());
}

// κ_d μ with the sign of the one bound.
double BarrierProblem::Damping(int i, double mu) const {
  if (has_lower(i) && !has_upper(i)) return kDamping * mu;
  if (has_upper(i) && !has_lower(i)) return -kDamping * mu;
  return 0;
}

double BarrierProblem::Barrier(double f, const VectorX& w, double mu) const {
  double logarithms = 0, damping = 0;
  for (int i = 0; i < unknowns(); ++i) {
    if (has_lower(i)) {
      logarithms += std::log(w(i) - lower_(i));
      if (!has_upper(i)) damping += w(i) - lower_(i);
    }
    if (has_upper(i)) {
      logarithms += std::log(upper_(i) - w(i));
      if (!has_lower(i)) damping += upper_(i) - w(i);
    }
  }
  return f - mu * logarithms + kDamping * mu * damping;
}

void BarrierProblem::AddBarrierGradient(const Point& point, double mu, const VectorX& base, VectorX* gradient) const {
  *gradient = base;
  for (int i = 0; i < unknowns(); ++i) {
    if (fixed(i)) {
      (*gradient)(i) = 0;
      continue;
    }
    if (has_lower(i)) (*gradient)(i) -= mu / (point.w(i) - lower_(i));
    if (has_upper(i)) (*gradient)(i) += mu / (upper_(i) - point.w(i));
    (*gradient)(i) += Damping(i, mu);
  }
}

void BarrierProblem::KeepDistance(const VectorX& w, double mu) {
  constexpr double kEpsilon = 2.2e-16;
  for (int i = 0; i < unknowns(); ++i) {
    const double least = kEpsilon * std::min(1.0, mu);
    const double move = 1.8e-12 * std::max(1.0, std::abs(w(i)));  // ε^(3/4)
    const bool at_lower = has_lower(i) && w(i) - lower_(i) < least, at_upper = has_upper(i) && upper_(i) - w(i) < least;
    if (at_lower) lower_(i) = w(i) - move;
    if (at_upper) upper_(i) = w(i) + move;
    if (at_lower || at_upper) moved_[i] = 1;
  }
}

std::vector<BarrierProblem::MovedBound> BarrierProblem::MovedBounds() const {
  std::vector<MovedBound> bounds;
  for (int i = 0; i < unknowns(); ++i) {
    if (moved_[i] != 0) bounds.push_back({i, lower_(i), upper_(i)});
  }
  return bounds;
}

bool BarrierProblem::MoveBounds(const std::vector<MovedBound>& bounds) {
  for (const MovedBound& bound : bounds) {
    const int i = bound.unknown;
    if (i < 0 || i >= unknowns()) return false;
    const bool lower_fits =
        has_lower(i) ? std::isfinite(bound.lower) && bound.lower <= lower_(i) : bound.lower == -kInfinity;
    const bool upper_fits =
        has_upper(i) ? std::isfinite(bound.upper) && bound.upper >= upper_(i) : bound.upper == kInfinity;
    if (!lower_fits || !upper_fits) return false;
  }
  for (const MovedBound& bound : bounds) {
    lower_(bound.unknown) = bound.lower;
    upper_(bound.unknown) = bound.upper;
    moved_[bound.unknown] = 1;
  }
  return true;
}

}  // namespace rollgait
