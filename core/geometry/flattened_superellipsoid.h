#ifndef ROLLGAIT_CORE_GEOMETRY_FLATTENED_SUPERELLIPSOID_H_
#define ROLLGAIT_CORE_GEOMETRY_FLATTENED_SUPERELLIPSOID_H_

#include <string>

#include "core/base/result.h"
#include "core/geometry/convex_function.h"
#include "core/geometry/implicit_surface.h"

namespace rollgait {

// A boxy superellipsoid whose flat faces are given a curvature: with F(x) = 1 Barr's equation (superellipsoid.h),
//   Φ = (F + δ (x²/a² + y²/b² + z²/c²)) / (1 + δ) − 1.
// The semi-axes stay; the largest radius of curvature at the end of an axis c across a is a² (1/ε₁ + δ)/(δ c). Flats
// must be removed here, in Φ: a Minkowski sum (Surface::Rounded) adds to S and leaves them flat. Source: contact-math
// 2.2.
class FlattenedSuperellipsoid : public ConvexFunction {
 public:
  static constexpr double kMinDelta = 1e-6, kMaxDelta = 1;

  // Refuses, besides what Superellipsoid refuses, exponents above 1 (pinched bodies have edges, not flats: round them)
  // and δ outside kMinDelta … kMaxDelta. Violations name field + ".flattening" or as Superellipsoid does.
  static Result<ImplicitSurface> Create(const Vector3& semi_axes, double exponent_1, double exponent_2, double delta,
                                        const std::string& field = "superellipsoid");

  const Vector3& semi_axes() const { return semi_axes_; }  // m
  double exponent_1() const { return exponent_1_; }
  double exponent_2() const { return exponent_2_; }
  double delta() const { return delta_; }

  double Value(const Vector3& x) const override;
  Vector3 Gradient(const Vector3& x) const override;
  Matrix3 Hessian(const Vector3& x) const override;
  Matrix3 Third(const Vector3& x, const Vector3& u) const override;
  Matrix3 Fourth(const Vector3& x, const Vector3& u, const Vector3& w) const override;
  // At x = 0 in one coordinate with an exponent 2/ε that is no even number, derivatives end at the exponent.
  int derivatives() const override { return 4; }

 private:
  FlattenedSuperellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2, double delta);
  class Partials;

  Vector3 semi_axes_;
  double exponent_1_, exponent_2_, delta_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_FLATTENED_SUPERELLIPSOID_H_
