#include "client/import/mjcf_mass.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>

#include "client/import/lumped_links.h"
#include "client/principal_axes.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

struct GeomType {
  const char* name;
  TreeShape::Kind kind;
  size_t sizes;  // how many numbers of `size` it needs
  bool has_fromto;
};
constexpr GeomType kSolids[] = {{"sphere", TreeShape::Kind::kSphere, 1, false},
                                {"capsule", TreeShape::Kind::kCapsule, 2, true},
                                {"ellipsoid", TreeShape::Kind::kEllipsoid, 3, true},
                                {"cylinder", TreeShape::Kind::kCylinder, 2, true},
                                {"box", TreeShape::Kind::kBox, 3, true}};

double Volume(const TreeShape& shape) {
  const Eigen::Vector3d& s = shape.half_size;
  switch (shape.kind) {
    case TreeShape::Kind::kBox:
      return 8 * s.prod();
    case TreeShape::Kind::kCylinder:
      return 2 * kPi * s.prod();
    case TreeShape::Kind::kCapsule:
      return kPi * s.x() * s.x() * (2 * s.z() + 4 * s.x() / 3);
    default:
      return 4 * kPi / 3 * s.prod();
  }
}

// About the centre, along the shape's axes, for a mass of 1.
Eigen::Vector3d UnitInertia(const TreeShape& shape) {
  const Eigen::Vector3d s = shape.half_size.cwiseAbs2();
  const Eigen::Vector3d others(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  const double r = shape.half_size.x(), h = 2 * shape.half_size.z();
  switch (shape.kind) {
    case TreeShape::Kind::kBox:
      return others / 3;
    case TreeShape::Kind::kCylinder:
      return {(3 * r * r + h * h) / 12, (3 * r * r + h * h) / 12, r * r / 2};
    case TreeShape::Kind::kCapsule: {
      const double ends = 4 * r / (4 * r + 3 * h), middle = 1 - ends;  // shares of the mass
      const double across = middle * (3 * r * r + h * h) / 12 + ends * (2 * r * r / 5 + h * (3 * r + 2 * h) / 8);
      return {across, across, middle * r * r / 2 + ends * 2 * r * r / 5};
    }
    default:
      return others / 5;
  }
}

// Size and place of a solid.
TreeShape SolidOf(const MjcfElement& geom, const GeomType& type) {
  TreeShape shape{type.kind, Eigen::Vector3d::Zero(), kNoMotion};
  std::vector<double> size = geom.Overlaid("size", 3);
  const std::vector<double> ends = geom.Numbers("fromto", 6, 6);
  const bool spans = !ends.empty();
  if (spans && !type.has_fromto) geom.Refuse(std::string("has fromto, which a ") + type.name + " does not have");
  const size_t needed = spans ? 1 : type.sizes;
  if (size.size() < needed) {
    geom.Refuse("size has " + std::to_string(size.size()) + " numbers; a " + type.name + " needs " +
                std::to_string(needed));
  }
  size.resize(3, 0);
  if (spans) {
    const Eigen::Vector3d from(ends[0], ends[1], ends[2]), to(ends[3], ends[4], ends[5]);
    size = {size[0], size[0], (to - from).norm() / 2};
    shape.place = {TurnOfZ(geom, from - to), (from + to) / 2};
  } else {
    if (type.sizes == 1) size = {size[0], size[0], size[0]};
    if (type.sizes == 2) size = {size[0], size[0], size[1]};
    shape.place = geom.Place();
  }
  shape.half_size = {size[0], size[1], size[2]};
  if (!(shape.half_size.minCoeff() > 0)) geom.Refuse("a size is <= 0");
  return shape;
}

}  // namespace

MjcfGeom ReadMjcfGeom(const MjcfElement& geom) {
  MjcfGeom result;
  const char* const given = geom.Get("type");
  const std::string type = geom.Has("mesh") ? "mesh" : given == nullptr ? "sphere" : given;
  const double mass = geom.Number("mass", -1), density = geom.Number("density", 1000);
  if (geom.Has("mass") && mass < 0) geom.Refuse("mass is " + FormatNumber(mass) + " kg; must be at least 0");
  if (density < 0) geom.Refuse("density is " + FormatNumber(density) + " kg/m³; must be at least 0");
  const double group = geom.Number("group", 0);
  const bool counts = group >= geom.compiler().first_group && group <= geom.compiler().last_group &&
                      (geom.Has("mass") ? mass > 0 : density > 0);
  if (type == "plane") return result;
  if (type == "hfield" || type == "mesh" || type == "sdf") {
    result.is_file = true;
    result.weighs_as_file = counts && type != "hfield";
    return result;
  }
  const auto solid =
      std::find_if(std::begin(kSolids), std::end(kSolids), [&](const GeomType& t) { return type == t.name; });
  if (solid == std::end(kSolids)) {
    geom.Refuse("type \"" + type.substr(0, 40) +
                "\" is unknown; must be plane, sphere, capsule, ellipsoid, cylinder, box, hfield, mesh or sdf");
  }
  const TreeShape shape = SolidOf(geom, *solid);
  if (geom.Number("contype", 1) != 0 || geom.Number("conaffinity", 1) != 0) result.shape = shape;
  if (!counts) return result;
  const char* const shell = geom.Get("shellinertia");
  if (shell != nullptr && geom.source().Flag(geom.xml(), "shellinertia", shell)) {
    geom.Refuse("has shellinertia, which is not read; give the body an <inertial>");
  }
  const double weight = geom.Has("mass") ? mass : density * Volume(shape);
  const Eigen::Matrix3d inertia = (weight * UnitInertia(shape)).asDiagonal();
  result.mass = Placed({weight, Eigen::Vector3d::Zero(), inertia}, shape.place);
  return result;
}

MassProperties ReadMjcfInertial(const MjcfElement& inertial) {
  if (!inertial.Has("mass")) inertial.Refuse("needs the attribute mass");
  if (!inertial.Has("pos")) inertial.Refuse("needs the attribute pos");
  const double mass = inertial.Number("mass", 0);
  if (mass < 0) inertial.Refuse("mass is " + FormatNumber(mass) + " kg; must be at least 0");
  const std::vector<double> full = inertial.Numbers("fullinertia", 6, 6),
                            diagonal = inertial.Numbers("diaginertia", 3, 3);
  if (!full.empty() && !diagonal.empty()) inertial.Refuse("has both diaginertia and fullinertia; give one");
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  if (!diagonal.empty()) inertia.diagonal() << diagonal[0], diagonal[1], diagonal[2];
  if (!full.empty()) {
    inertia << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2];
  }
  return Placed({mass, Eigen::Vector3d::Zero(), inertia}, inertial.Place());
}

MassProperties BoundedMass(const MjcfCompiler& compiler, const MassProperties& mass) {
  MassProperties bounded = mass;
  bounded.mass = std::max(mass.mass, compiler.bound_mass);
  if (!(compiler.bound_inertia > 0) && !compiler.balance_inertia) return bounded;
  const PrincipalAxes principal = PrincipalAxesOf(mass.inertia);
  Eigen::Vector3d moments = principal.moments.cwiseMax(compiler.bound_inertia);
  if (compiler.balance_inertia && moments(0) + moments(1) < moments(2)) moments.setConstant(moments.mean());
  bounded.inertia = principal.axes * moments.asDiagonal() * principal.axes.transpose();
  return bounded;
}

}  // namespace rollgait::client
