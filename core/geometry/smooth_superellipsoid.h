#ifndef ROLLGAIT_CORE_GEOMETRY_SMOOTH_SUPERELLIPSOID_H_
#define ROLLGAIT_CORE_GEOMETRY_SMOOTH_SUPERELLIPSOID_H_

#include <array>
#include <string>

#include "core/base/result.h"
#include "core/geometry/support_jet.h"
#include "core/geometry/walking_shape.h"

namespace rollgait {

// A superellipsoid (superellipsoid.h) without flats, edges and tips, so that it has all derivatives at every normal.
// In  t = (w₁ν₁, w₂ν₂, w₃ν₃)  the support function of a superellipsoid is the norm
//   h = N(N(|t₁|, |t₂|; q₂), |t₃|; q₁),  q = 2/(2 − ε);
// here √(t_i² + σ²‖t‖²) stands for |t_i|. A norm of norms is a norm, so h is the support function of a convex body for
// every ε and σ > 0. The scales w are chosen so that the semi-axes stay what they are. With ε₁ = ε₂ = 1 the body is the
// ellipsoid, whatever σ; as σ → 0 it becomes the superellipsoid. Where ε₁ = ε₂ = ε, the radius of curvature at the end
// of c across a is  a²/c (σ^(q − 2) (1 + 2σ²) + σ² (1 + σ²)^(q/2 − 1)) / (2σ^q + (1 + σ²)^(q/2)):  finite, larger than
// the ellipsoid's for ε < 1, smaller for ε > 1.
// Immutable; any thread may share it.
class SmoothSuperellipsoid {
 public:
  static constexpr double kMinSmoothing = 0.01, kMaxSmoothing = 1;
  static constexpr char kWalks[] = "a superellipsoid with smoothing";
  // Of a body that walks (docs/explanation/walking.md).
  static constexpr double kLeastWalkingExponent = 0.4, kMostWalkingExponent = 1.8, kLeastWalkingSmoothing = 0.1;

  // Refuses, besides what Superellipsoid refuses, σ outside kMinSmoothing … kMaxSmoothing. Violations name field +
  // ".smoothing" or as Superellipsoid does.
  static Result<SmoothSuperellipsoid> Create(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                             double smoothing, const std::string& field = "superellipsoid");
  // Contract: what Create demands.
  SmoothSuperellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2, double smoothing);

  const Vector3& semi_axes() const { return semi_axes_; }  // m
  double exponent_1() const { return exponent_1_; }        // ε₁, along z
  double exponent_2() const { return exponent_2_; }        // ε₂, around z
  double smoothing() const { return smoothing_; }          // σ

  double Support(const Vector3& nu) const;
  Vector3 SupportPoint(const Vector3& nu) const;
  Matrix3 SupportHessian(const Vector3& nu) const;
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // See Surface::Evaluate.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;
  WalkingShape Walking() const;

 private:
  // The squares t_i² + σ²‖t‖² as quadratic forms of ν: factors of ν_j² in column i.
  Matrix3 squares_;
  Vector3 semi_axes_;
  double scale_;  // m, largest semi-axis
  double exponent_1_, exponent_2_, smoothing_;
  double q_1_, q_2_;  // dual exponents, along z and around z
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_SMOOTH_SUPERELLIPSOID_H_
