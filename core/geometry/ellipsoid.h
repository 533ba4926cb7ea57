#ifndef ROLLGAIT_CORE_GEOMETRY_ELLIPSOID_H_
#define ROLLGAIT_CORE_GEOMETRY_ELLIPSOID_H_

#include "core/geometry/support_jet.h"
#include "core/geometry/walking_shape.h"

namespace rollgait {

// Ellipsoid in its own principal axes. Every member works in those axes and takes a unit outward normal `nu`.
// Notation and formulas: h = support function, x = ∇h, S = ∇²h, T = D S, Q = D² S (docs/explanation/notation.md).
// Immutable; any thread may share it. Contract: semi-axes finite and > 0.
class Ellipsoid {
 public:
  static constexpr char kWalks[] = "an ellipsoid";

  explicit Ellipsoid(const Vector3& semi_axes);

  const Vector3& semi_axes() const { return semi_axes_; }

  // h(ν) = ‖Dν‖, m: distance from the centre to the tangent plane with normal ν.
  double Support(const Vector3& nu) const;
  // x(ν) = ∇h, m: the point of the surface with outward normal ν. Source: eq. (2.10) with n = −ν.
  Vector3 SupportPoint(const Vector3& nu) const;
  // S(ν) = ∇²h, m: inverse Weingarten map, symmetric, Sν = 0. Stable form [ν]ᵀ C [ν] / s³: every entry keeps full
  // relative accuracy for any axis ratio.
  Matrix3 SupportHessian(const Vector3& nu) const;
  // T(ν)[u] = D S(ν)[u], m.
  Matrix3 SupportThird(const Vector3& nu, const Vector3& u) const;
  // Q(ν)[u, w] = D² S(ν)[u, w], m.
  Matrix3 SupportFourth(const Vector3& nu, const Vector3& u, const Vector3& w) const;
  // See Surface::RollingVelocity. Stable form  ν × (C ω_t) / s³  with ω_t = (ν × ω) × ν.
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // See Surface::TangentHessian.
  Eigen::Matrix2d TangentHessian(const Vector3& nu, const Eigen::Matrix<double, 3, 2>& tangents) const;
  // All of them by components; see Surface::Evaluate.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;
  WalkingShape Walking() const { return {"ellipsoid", semi_axes_, {}, {}}; }

 private:
  // The same quantities of the ellipsoid divided by its largest semi-axis; s = h(nu), x = x(nu) of that ellipsoid.
  Matrix3 UnitHessian(const Vector3& nu, double s) const;
  static Matrix3 UnitThird(const Vector3& x, const Matrix3& hessian, double s, const Vector3& u);

  Vector3 semi_axes_;
  double scale_;       // m, largest semi-axis
  Vector3 unit_axes_;  // semi-axes / scale
  Vector3 cofactors_;  // products of the squares of the other two unit axes
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_ELLIPSOID_H_
