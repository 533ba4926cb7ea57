#include "bench/verdict_audit/smooth_body.h"

#include <array>
#include <cmath>
#include <complex>

#include "core/base/check.h"

namespace rollgait::audit {
namespace {

template <typename Number>
Number Norm(const std::array<Number, 3>& t, double q_1, double q_2, double smoothing) {
  const Number round = smoothing * smoothing * (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
  const auto power = [&](const Number& of, double q) { return std::pow(of * of + round, q / 2); };
  return std::pow(std::pow(power(t[0], q_2) + power(t[1], q_2), q_1 / q_2) + power(t[2], q_1), 1 / q_1);
}

// The support function with components of any number type.
template <typename Number>
Number Height(const SmoothBody& body, const std::array<Number, 3>& nu) {
  const double q_1 = 2 / (2 - body.exponent_1), q_2 = 2 / (2 - body.exponent_2);
  std::array<Number, 3> t;
  for (size_t i = 0; i < 3; ++i) {
    std::array<double, 3> axis = {0, 0, 0};
    axis[i] = 1;
    t[i] = nu[i] * (body.semi_axes[static_cast<int>(i)] / Norm(axis, q_1, q_2, body.smoothing));
  }
  return Norm(t, q_1, q_2, body.smoothing);
}

}  // namespace

double SmoothBody::Support(const Vector3& nu) const {
  if (smoothing == 0) return semi_axes.cwiseProduct(nu).norm();
  return Height<double>(*this, {nu.x(), nu.y(), nu.z()});
}

Vector3 SmoothBody::Furthest(const Vector3& nu) const {
  constexpr double kStep = 1e-30;
  Vector3 point;
  for (size_t i = 0; i < 3; ++i) {
    std::array<std::complex<double>, 3> moved = {nu.x(), nu.y(), nu.z()};
    moved[i] += std::complex<double>(0, kStep);
    point[static_cast<int>(i)] = Height(*this, moved).imag() / kStep;
  }
  return point;
}

SmoothBody BodyOf(const Surface& surface) {
  const auto* const super = surface.plain<SmoothSuperellipsoid>();
  ROLLGAIT_CHECK(super != nullptr || surface.ellipsoid() != nullptr);
  if (super == nullptr) return {*surface.semi_axes()};
  return {super->semi_axes(), super->exponent_1(), super->exponent_2(), super->smoothing()};
}

}  // namespace rollgait::audit
