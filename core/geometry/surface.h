#ifndef ROLLGAIT_CORE_GEOMETRY_SURFACE_H_
#define ROLLGAIT_CORE_GEOMETRY_SURFACE_H_

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/covered_ellipsoid.h"
#include "core/geometry/ellipsoid.h"
#include "core/geometry/implicit_surface.h"
#include "core/geometry/smooth_superellipsoid.h"
#include "core/geometry/sphere.h"
#include "core/geometry/superellipsoid.h"
#include "core/geometry/support_jet.h"
#include "core/geometry/walking_shape.h"

namespace rollgait {

// The boundary of a strictly convex body, in its own axes: one of the kinds below, its centre moved to `center`, and
// rolled over with a ball of radius `rounding` (Minkowski sum: every edge gets at least that radius; flats stay flat).
// Everything contact needs of a body is its support function h and the derivatives x = ∇h, S, T, Q; `nu` is a unit
// outward normal. Source: contact-math 2. A value; immutable; any thread may share it. Dispatch is a switch over the
// kinds, no virtual call.
class Surface {
 public:
  using Kind = std::variant<Ellipsoid, Sphere, Superellipsoid, SmoothSuperellipsoid, ImplicitSurface, CoveredEllipsoid>;

  Surface(Kind kind) : kind_(std::move(kind)) {}  // NOLINT: a surface of that kind
  template <typename Body>
  requires std::is_constructible_v<Kind, const Body&> Surface(const Body& body) : kind_(body) {}  // NOLINT

  // The same body with its origin at `center` (m) of the axes it is described in; and rounded by `radius` (m, ≥ 0,
  // added to what it has). Contract: finite.
  Surface MovedTo(const Vector3& center) const;
  Surface Rounded(double radius) const;

  const Kind& kind() const { return kind_; }
  const Vector3& center() const { return center_; }
  double rounding() const { return rounding_; }
  // The body if it is of that kind, about the origin and not rounded; otherwise null.
  template <typename Body>
  const Body* plain() const {
    return plain_ ? std::get_if<Body>(&kind_) : nullptr;
  }
  const Ellipsoid* ellipsoid() const { return plain<Ellipsoid>(); }
  // Of a body that can walk: of a kind that has a WalkingShape, about the origin and not rounded; otherwise nothing.
  const Vector3* semi_axes() const;
  std::optional<WalkingShape> walking() const;
  // Names of those kinds: "an ellipsoid", "a superellipsoid with smoothing".
  static std::vector<std::string> WalkingKinds();

  double Support(const Vector3& nu) const;          // h, m
  Vector3 SupportPoint(const Vector3& nu) const;    // x, m
  Matrix3 SupportHessian(const Vector3& nu) const;  // S, m; every entry infinite where the surface is flat
  Matrix3 SupportThird(const Vector3& nu, const Vector3& u) const;                     // T[u], m
  Matrix3 SupportFourth(const Vector3& nu, const Vector3& u, const Vector3& w) const;  // Q[u, w], m
  // S(ν)(ν × ω), m/s for ω in rad/s: velocity of the contact point over the surface when the body turns at ω relative
  // to the plane (surface axes). Spin about ν does not count. Keeps more digits than the matrix: contact-math 9.2, 9.3.
  // Every entry infinite where S is.
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // tᵀ S t for two tangents (columns, orthonormal, ⟂ ν), m. Along the directions of curvature both radii keep their own
  // digits, whatever their ratio. Infinite where S is.
  Eigen::Matrix2d TangentHessian(const Vector3& nu, const Eigen::Matrix<double, 3, 2>& tangents) const;
  // All of them up to `order` (1 = x, 2 = S, 3 = T, 4 = Q) at the price of the last; says which of them exist.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;

  // Half the largest extent along the body's axes, m: the length by which errors are measured.
  double Size() const;

 private:
  Kind kind_;
  Vector3 center_ = Vector3::Zero();
  double rounding_ = 0;
  bool plain_ = true;  // center_ and rounding_ are zero
};

// The largest difference of the support functions of two bodies over a fixed set of directions, m; R maps the axes of a
// body to common ones and may be a reflection. 0: they have the same shape, up to what those directions do not see.
double SupportDifference(const Surface& first, const Matrix3& R_first, const Surface& second, const Matrix3& R_second);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_SURFACE_H_
