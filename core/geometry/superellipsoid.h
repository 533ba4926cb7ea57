#ifndef ROLLGAIT_CORE_GEOMETRY_SUPERELLIPSOID_H_
#define ROLLGAIT_CORE_GEOMETRY_SUPERELLIPSOID_H_

#include <string>

#include "core/base/result.h"
#include "core/geometry/support_jet.h"

namespace rollgait {

// Barr's superellipsoid  ((|x|/a)^(2/ε₂) + (|y|/b)^(2/ε₂))^(ε₂/ε₁) + (|z|/c)^(2/ε₁) = 1,  0 < ε < 2: boxy below 1, the
// ellipsoid at 1, pinched above. Its support function is the nested dual norm with q = 2/(2 − ε), so contact with a
// plane is in closed form, with all derivatives. Source: contact-math 2.2. Differs: the paper, 2.3, says that there is
// no analytical solution.
//
// Where a component of ν is exactly zero h is as smooth as |ν|^q: the jet's order says how far derivatives exist there.
//   ε < 1 (1 < q < 2)   flat: S infinite, order 1, unless q is 2. Close by S is finite and huge, like |ν|^(q − 2).
//   ε > 1 (q > 2) edge or tip: S exists, with an eigenvalue 0; T exists for q > 3 (ε > 4/3), Q for q > 4 (ε > 3/2)
//                       or where q is an even number.
// At ν = ±e_z both rules meet; a mixed point (ε₁ = 1, ε₂ ≠ 1) has a curvature that depends on the direction: order 1.
// Immutable; any thread may share it.
class Superellipsoid {
 public:
  // Exponents for which double precision keeps the accuracy that docs/explanation/numerical_limits.md states.
  static constexpr double kMinExponent = 0.05, kMaxExponent = 1.95;

  // Refuses semi-axes that are not finite and > 0, and exponents outside kMinExponent … kMaxExponent. Violations name
  // field + ".semi_axes_m", ".exponent_1", ".exponent_2".
  static Result<Superellipsoid> Create(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                       const std::string& field = "superellipsoid");
  // Contract: what Create demands.
  Superellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2);

  const Vector3& semi_axes() const { return semi_axes_; }  // m
  double exponent_1() const { return exponent_1_; }        // ε₁, along z
  double exponent_2() const { return exponent_2_; }        // ε₂, around z

  double Support(const Vector3& nu) const;
  Vector3 SupportPoint(const Vector3& nu) const;
  Matrix3 SupportHessian(const Vector3& nu) const;
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // See Surface::Evaluate. Neither overflows nor underflows for components of ν down to the smallest normal number.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;

 private:
  // The highest order of derivatives of h that exist at ν.
  int Smoothness(const Vector3& nu) const;

  Vector3 semi_axes_;
  double scale_;       // m, largest semi-axis
  Vector3 unit_axes_;  // semi-axes / scale
  double exponent_1_, exponent_2_;
  double q_1_, q_2_;  // dual exponents, along z and around z
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_SUPERELLIPSOID_H_
