#ifndef ROLLGAIT_TESTS_PAPER_MOVING_ELLIPSOID_H_
#define ROLLGAIT_TESTS_PAPER_MOVING_ELLIPSOID_H_

#include <Eigen/Geometry>

#include "core/geometry/ellipsoid.h"
#include "core/multibody/spatial.h"

namespace rollgait {

inline Matrix3 Rotation(const Vector3& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

// Derivative at t = 0 by the five-point formula. Step 1e-3: the error is h⁴/30 of the fifth derivative, which is below
// 1e5 times the size of the value for the motions here, and rounding adds 1e-13.
template <typename F>
auto Derivative(const F& f) {
  const double h = 1e-3;
  return ((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)).eval();
}
inline constexpr double kDerivativeTolerance = 1e-8;

// The ellipsoid of the paper's section 2.2 in motion over a plane through the origin with normal n (out of the ground).
// Notation of the paper: C centre, P lowest point along n, A = R diag(1/a²) Rᵀ. World axes, SI units.
struct MovingEllipsoid {
  Ellipsoid ellipsoid{Vector3(0.7, 0.23, 1.9)};
  Vector3 n = Vector3(0.3, -0.5, 0.8).normalized();
  Matrix3 R0 = Rotation({0.4, -1.1, 0.7});
  Vector3 omega{0.9, -1.3, 1.2}, alpha{-0.6, 0.5, 0.8};  // at t = 0
  Vector3 c0{0.2, -0.1, 1.5}, v{0.7, 0.3, -0.4}, a{-0.2, 0.9, 0.6};

  Matrix3 R(double t) const { return Rotation(omega * t + alpha * (t * t / 2)) * R0; }
  Vector3 C(double t) const { return c0 + v * t + a * (t * t / 2); }
  // Outward normal of the ellipsoid at P, in its principal axes.
  Vector3 nu(double t) const { return -(R(t).transpose() * n); }
  // The vector CP in world axes.
  Vector3 CP(double t) const { return R(t) * ellipsoid.SupportPoint(nu(t)); }
  // A⁻¹ in world axes.
  Matrix3 InverseA(double t) const { return R(t) * ellipsoid.semi_axes().cwiseAbs2().asDiagonal() * R(t).transpose(); }
  // Inverse Weingarten map at P in world axes.
  Matrix3 S() const { return R0 * ellipsoid.SupportHessian(nu(0)) * R0.transpose(); }
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_PAPER_MOVING_ELLIPSOID_H_
