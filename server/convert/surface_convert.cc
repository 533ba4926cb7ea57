#include "server/convert/surface_convert.h"

#include <sstream>

#include "core/base/check.h"
#include "core/geometry/flattened_superellipsoid.h"

namespace rollgait::server {
namespace {

constexpr double kPointRadius = 1e-15;  // m; a sphere of radius 0 is computed as one of this radius
constexpr double kMaxRadius = 1e6;      // m

void EncodeAxes(const Vector3& axes, v1::Vector3* encoded) {
  encoded->set_x(axes.x());
  encoded->set_y(axes.y());
  encoded->set_z(axes.z());
}

Vector3 DecodeAxes(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::optional<Surface> DecodeEllipsoid(const std::string& field, const v1::Ellipsoid& shape, Violations* violations) {
  const Vector3 axes = DecodeAxes(shape.semi_axes_m());
  if (axes.allFinite() && axes.minCoeff() > 0 && axes.maxCoeff() <= kMaxRadius) return Ellipsoid(axes);
  std::ostringstream message;
  message << "is " << axes.transpose() << "; every semi-axis must be larger than 0 and at most 1e6 m";
  violations->push_back({field + ".semi_axes_m", message.str()});
  return std::nullopt;
}

std::optional<Surface> DecodeSphere(const std::string& field, const v1::Sphere& shape, Violations* violations) {
  const double radius = shape.radius_m();
  if (radius >= 0 && radius <= kMaxRadius) return Sphere(radius > 0 ? radius : kPointRadius);
  violations->push_back({field + ".radius_m", "is " + std::to_string(radius) + "; must be within [0, 1e6] m"});
  return std::nullopt;
}

std::optional<Surface> DecodeSuperellipsoid(const std::string& field, const v1::Superellipsoid& shape,
                                            Violations* violations) {
  const Vector3 axes = DecodeAxes(shape.semi_axes_m());
  const double e_1 = shape.exponent_1(), e_2 = shape.exponent_2();
  const auto take = [&](const auto& created) -> std::optional<Surface> {
    if (created.ok()) return Surface(created.value());
    violations->insert(violations->end(), created.violations().begin(), created.violations().end());
    return std::nullopt;
  };
  if (shape.flattening() != 0 && shape.smoothing() != 0) {
    violations->push_back({field + ".smoothing", "is set together with flattening; give one of the two"});
    return std::nullopt;
  }
  if (shape.smoothing() != 0) return take(SmoothSuperellipsoid::Create(axes, e_1, e_2, shape.smoothing(), field));
  if (shape.flattening() != 0) return take(FlattenedSuperellipsoid::Create(axes, e_1, e_2, shape.flattening(), field));
  return take(Superellipsoid::Create(axes, e_1, e_2, field));
}

}  // namespace

void EncodeSurface(const Surface& surface, v1::Surface* encoded) {
  ROLLGAIT_CHECK(surface.semi_axes() != nullptr);
  if (const auto* shape = surface.plain<SmoothSuperellipsoid>()) {
    v1::Superellipsoid& super = *encoded->mutable_superellipsoid();
    EncodeAxes(shape->semi_axes(), super.mutable_semi_axes_m());
    super.set_exponent_1(shape->exponent_1());
    super.set_exponent_2(shape->exponent_2());
    super.set_smoothing(shape->smoothing());
  } else {
    EncodeAxes(*surface.semi_axes(), encoded->mutable_ellipsoid()->mutable_semi_axes_m());
  }
}

std::optional<Surface> DecodeSurface(const std::string& field, const v1::Surface& surface, Violations* violations) {
  std::optional<Surface> decoded;
  switch (surface.shape_case()) {
    case v1::Surface::kEllipsoid:
      decoded = DecodeEllipsoid(field + ".ellipsoid", surface.ellipsoid(), violations);
      break;
    case v1::Surface::kSphere:
      decoded = DecodeSphere(field + ".sphere", surface.sphere(), violations);
      break;
    case v1::Surface::kSuperellipsoid:
      decoded = DecodeSuperellipsoid(field + ".superellipsoid", surface.superellipsoid(), violations);
      break;
    case v1::Surface::SHAPE_NOT_SET:
      violations->push_back({field, "is not set; give an ellipsoid, a sphere or a superellipsoid"});
  }
  if (!(surface.rounding_m() >= 0 && surface.rounding_m() <= kMaxRadius)) {
    violations->push_back(
        {field + ".rounding_m", "is " + std::to_string(surface.rounding_m()) + "; must be within [0, 1e6] m"});
    return std::nullopt;
  }
  if (!decoded || surface.rounding_m() == 0) return decoded;
  return decoded->Rounded(surface.rounding_m());
}

}  // namespace rollgait::server
