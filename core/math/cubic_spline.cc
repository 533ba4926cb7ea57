#include "core/math/cubic_spline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/check.h"

namespace rollgait {

CubicSpline::CubicSpline(std::vector<double> values) : values_(std::move(values)) {
  ROLLGAIT_CHECK(values_.size() >= 2);
  const size_t last = values_.size() - 1;
  spacing_ = 1 / static_cast<double>(last);
  curvatures_.assign(last + 1, 0.0);
  // Continuity of the first derivative,  m_{i−1} + 4 m_i + m_{i+1} = 6 (y_{i−1} − 2 y_i + y_{i+1}) / spacing²,  by
  // elimination.
  std::vector<double> upper(last + 1, 0.0);
  for (size_t i = 1; i < last; ++i) {
    const double pivot = 4 - upper[i - 1];
    const double difference = values_[i - 1] - 2 * values_[i] + values_[i + 1];
    upper[i] = 1 / pivot;
    curvatures_[i] = (6 * difference / (spacing_ * spacing_) - curvatures_[i - 1]) / pivot;
  }
  for (size_t i = last - 1; i > 0; --i) curvatures_[i] -= upper[i] * curvatures_[i + 1];
}

CubicSpline::Place CubicSpline::Find(double theta) const {
  const int pieces = static_cast<int>(values_.size()) - 1;
  const double scaled = theta / spacing_;
  const double piece = std::clamp(std::floor(scaled), 0.0, static_cast<double>(pieces - 1));
  return {static_cast<int>(piece), scaled - piece};
}

double CubicSpline::Value(double theta) const {
  const auto [i, t] = Find(theta);
  const double s = 1 - t;
  return s * values_[i] + t * values_[i + 1] +
         spacing_ * spacing_ / 6 * ((s * s * s - s) * curvatures_[i] + (t * t * t - t) * curvatures_[i + 1]);
}

double CubicSpline::First(double theta) const {
  const auto [i, t] = Find(theta);
  const double s = 1 - t;
  return (values_[i + 1] - values_[i]) / spacing_ +
         spacing_ / 6 * ((1 - 3 * s * s) * curvatures_[i] + (3 * t * t - 1) * curvatures_[i + 1]);
}

double CubicSpline::Second(double theta) const {
  const auto [i, t] = Find(theta);
  return (1 - t) * curvatures_[i] + t * curvatures_[i + 1];
}

}  // namespace rollgait
