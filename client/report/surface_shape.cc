#include "client/report/surface_shape.h"

#include <cmath>

#include "client/failure.h"
#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {

using Eigen::Vector3d;

namespace {

// Of the superellipsoid with smoothing, as rollgait.v1.Superellipsoid defines it.
SupportNorm SmoothNorm(const v1::Superellipsoid& shape) {
  const double round = shape.smoothing() * shape.smoothing();
  const auto smoothed = [round](int axis) {
    SupportNorm part;
    part.squares = Vector3d::Constant(round) + Vector3d::Unit(axis);
    return part;
  };
  const SupportNorm around{2 / (2 - shape.exponent_2()), {smoothed(0), smoothed(1)}};
  return {2 / (2 - shape.exponent_1()), {around, smoothed(2)}};
}

void Stretch(const Vector3d& squares, SupportNorm* norm) {
  norm->squares = norm->squares.cwiseProduct(squares);
  for (SupportNorm& part : norm->parts) Stretch(squares, &part);
}

// With axes scaled so that the semi-axes are 1.
SupportNorm WithUnitAxes(SupportNorm norm) {
  Vector3d squares;
  for (int i = 0; i < 3; ++i) squares[i] = std::pow(norm.Value(Vector3d::Unit(i)), -2);
  Stretch(squares, &norm);
  return norm;
}

SurfaceShape ReadEllipsoid(const v1::Surface& surface) { return {ToVector(surface.ellipsoid().semi_axes_m()), {}, ""}; }

SurfaceShape ReadSphere(const v1::Surface& surface) {
  return {Vector3d::Constant(surface.sphere().radius_m()), {}, ""};
}

SurfaceShape ReadSuperellipsoid(const v1::Surface& surface) {
  const v1::Superellipsoid& shape = surface.superellipsoid();
  SurfaceShape read{ToVector(shape.semi_axes_m()), {}, ""};
  read.numbers = "exponents " + FormatNumber(shape.exponent_1()) + ", " + FormatNumber(shape.exponent_2());
  if (shape.smoothing() != 0) read.form = WithUnitAxes(SmoothNorm(shape));
  return read;
}

// The sum of the support functions of core and cover.
SurfaceShape ReadCoveredEllipsoid(const v1::Surface& surface) {
  const Vector3d axes = ToVector(surface.covered_ellipsoid().semi_axes_m());
  const Vector3d cover = ToVector(surface.covered_ellipsoid().cover_m());
  SurfaceShape read{axes, {}, ""};
  if (cover.isZero(0)) return read;
  SupportNorm core, around;
  core.squares = (axes - cover).cwiseQuotient(axes).cwiseAbs2();
  around.squares = cover.cwiseQuotient(axes).cwiseAbs2();
  read.form = SupportNorm{1, {core, around}};
  read.numbers =
      "cover " + FormatNumber(cover.x()) + ", " + FormatNumber(cover.y()) + ", " + FormatNumber(cover.z()) + " m";
  return read;
}

// The row of a shape of v1::Surface: pictures, tables and side files know no other place for it.
struct ShapeRow {
  v1::Surface::ShapeCase shape;
  const char* walks;  // its name in a sentence if bodies that walk may have it, else null
  SurfaceShape (*read)(const v1::Surface& surface);
};

constexpr ShapeRow kShapes[] = {
    {v1::Surface::kEllipsoid, "an ellipsoid", ReadEllipsoid},
    {v1::Surface::kSphere, nullptr, ReadSphere},
    {v1::Surface::kSuperellipsoid, "a superellipsoid", ReadSuperellipsoid},
    {v1::Surface::kCoveredEllipsoid, "a covered ellipsoid", ReadCoveredEllipsoid},
};

const ShapeRow* RowOf(const v1::Surface& surface) {
  for (const ShapeRow& row : kShapes) {
    if (row.shape == surface.shape_case()) return &row;
  }
  return nullptr;
}

}  // namespace

double SupportNorm::Value(const Vector3d& t) const {
  if (parts.empty()) return std::sqrt(squares.dot(t.cwiseAbs2()));
  double sum = 0;
  for (const SupportNorm& part : parts) sum += std::pow(part.Value(t), exponent);
  return std::pow(sum, 1 / exponent);
}

Vector3d SupportNorm::Gradient(const Vector3d& t) const {
  const double value = Value(t);
  if (parts.empty()) return squares.cwiseProduct(t) / value;
  Vector3d gradient = Vector3d::Zero();
  for (const SupportNorm& part : parts) {
    gradient += std::pow(part.Value(t) / value, exponent - 1) * part.Gradient(t);
  }
  return gradient;
}

nlohmann::json SupportNorm::ToJson() const {
  if (parts.empty()) return {{"squares", {squares.x(), squares.y(), squares.z()}}};
  nlohmann::json list = nlohmann::json::array();
  for (const SupportNorm& part : parts) list.push_back(part.ToJson());
  return {{"exponent", exponent}, {"parts", list}};
}

Vector3d SurfaceShape::FurthestPoint(const Vector3d& direction) const {
  const Vector3d stretched = semi_axes.cwiseProduct(direction);
  return semi_axes.cwiseProduct(form ? form->Gradient(stretched) : Vector3d(stretched.normalized()));
}

SurfaceShape ShapeOf(const v1::Surface& surface) {
  const ShapeRow* const row = RowOf(surface);
  if (row == nullptr) {
    throw Failure(ExitCode::kUsage, "a surface of the model has no shape that this client knows");
  }
  return row->read(surface);
}

bool MayWalk(const v1::Surface& surface) {
  const ShapeRow* const row = RowOf(surface);
  return row != nullptr && row->walks != nullptr;
}

std::string NamesOfWalkingShapes() {
  std::vector<std::string> names;
  for (const ShapeRow& row : kShapes) {
    if (row.walks != nullptr) names.emplace_back(row.walks);
  }
  std::string list = names.front();
  for (size_t i = 1; i < names.size(); ++i) list += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return list;
}

}  // namespace rollgait::client
