#include "server/convert/surface_convert.h"

#include <sstream>
#include <variant>

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

std::optional<Surface> DecodeCoveredEllipsoid(const std::string& field, const v1::CoveredEllipsoid& shape,
                                              Violations* violations) {
  const auto created = CoveredEllipsoid::Create(DecodeAxes(shape.semi_axes_m()), DecodeAxes(shape.cover_m()), field);
  if (created.ok()) return Surface(created.value());
  violations->insert(violations->end(), created.violations().begin(), created.violations().end());
  return std::nullopt;
}

// How a kind of surface is written; the visit in EncodeSurface does not compile without one for each.
void EncodeKind(const Ellipsoid& shape, v1::Surface* encoded) {
  EncodeAxes(shape.semi_axes(), encoded->mutable_ellipsoid()->mutable_semi_axes_m());
}

void EncodeKind(const Sphere& shape, v1::Surface* encoded) { encoded->mutable_sphere()->set_radius_m(shape.radius()); }

template <typename Super>
v1::Superellipsoid& EncodeSuperellipsoid(const Super& shape, v1::Surface* encoded) {
  v1::Superellipsoid& super = *encoded->mutable_superellipsoid();
  EncodeAxes(shape.semi_axes(), super.mutable_semi_axes_m());
  super.set_exponent_1(shape.exponent_1());
  super.set_exponent_2(shape.exponent_2());
  return super;
}

void EncodeKind(const Superellipsoid& shape, v1::Surface* encoded) { EncodeSuperellipsoid(shape, encoded); }

void EncodeKind(const SmoothSuperellipsoid& shape, v1::Surface* encoded) {
  EncodeSuperellipsoid(shape, encoded).set_smoothing(shape.smoothing());
}

void EncodeKind(const CoveredEllipsoid& shape, v1::Surface* encoded) {
  EncodeAxes(shape.semi_axes(), encoded->mutable_covered_ellipsoid()->mutable_semi_axes_m());
  EncodeAxes(shape.cover(), encoded->mutable_covered_ellipsoid()->mutable_cover_m());
}

// No message says an equation.
void EncodeKind(const ImplicitSurface&, v1::Surface*) {}

// The row of a shape of v1::Surface.
struct ShapeRow {
  v1::Surface::ShapeCase shape;
  const char* field;  // of the oneof
  const char* name;   // in a sentence
  std::optional<Surface> (*decode)(const std::string& field, const v1::Surface& surface, Violations* violations);
};

constexpr ShapeRow kShapes[] = {
    {v1::Surface::kEllipsoid, "ellipsoid", "an ellipsoid",
     [](const std::string& field, const v1::Surface& surface, Violations* violations) {
       return DecodeEllipsoid(field, surface.ellipsoid(), violations);
     }},
    {v1::Surface::kSphere, "sphere", "a sphere",
     [](const std::string& field, const v1::Surface& surface, Violations* violations) {
       return DecodeSphere(field, surface.sphere(), violations);
     }},
    {v1::Surface::kSuperellipsoid, "superellipsoid", "a superellipsoid",
     [](const std::string& field, const v1::Surface& surface, Violations* violations) {
       return DecodeSuperellipsoid(field, surface.superellipsoid(), violations);
     }},
    {v1::Surface::kCoveredEllipsoid, "covered_ellipsoid", "a covered ellipsoid",
     [](const std::string& field, const v1::Surface& surface, Violations* violations) {
       return DecodeCoveredEllipsoid(field, surface.covered_ellipsoid(), violations);
     }},
};

// "an ellipsoid, a sphere or a superellipsoid"
std::string NamesOfShapes() {
  std::string names;
  for (const ShapeRow& row : kShapes) {
    if (&row != std::begin(kShapes)) names += &row + 1 == std::end(kShapes) ? " or " : ", ";
    names += row.name;
  }
  return names;
}

std::optional<Surface> DecodeShape(const std::string& field, const v1::Surface& surface, Violations* violations) {
  for (const ShapeRow& row : kShapes) {
    if (row.shape == surface.shape_case()) return row.decode(field + "." + row.field, surface, violations);
  }
  violations->push_back({field, "is not set; give " + NamesOfShapes()});
  return std::nullopt;
}

}  // namespace

void EncodeSurface(const Surface& surface, v1::Surface* encoded) {
  encoded->Clear();
  if (!surface.center().isZero(0)) return;
  std::visit([encoded](const auto& shape) { EncodeKind(shape, encoded); }, surface.kind());
  encoded->set_rounding_m(surface.rounding());
}

std::optional<Surface> DecodeSurface(const std::string& field, const v1::Surface& surface, Violations* violations) {
  std::optional<Surface> decoded = DecodeShape(field, surface, violations);
  if (!(surface.rounding_m() >= 0 && surface.rounding_m() <= kMaxRadius)) {
    violations->push_back(
        {field + ".rounding_m", "is " + std::to_string(surface.rounding_m()) + "; must be within [0, 1e6] m"});
    return std::nullopt;
  }
  if (!decoded || surface.rounding_m() == 0) return decoded;
  return decoded->Rounded(surface.rounding_m());
}

}  // namespace rollgait::server
