#include "client/formats/link_shapes.h"

#include <algorithm>
#include <cmath>

#include "client/failure.h"
#include "client/formats/body_links.h"
#include "client/principal_axes.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

// ContactSurface and BodySurface have the same fields.
template <typename Placed>
LinkShape ShapeOf(LinkShape::Kind kind, const Placed& placed, const v1::Model& model) {
  if (placed.joint() < 0 || placed.joint() >= model.joints_size()) {
    throw Failure(ExitCode::kUsage, "surface " + placed.name() + ": the model has no joint of its index");
  }
  if (!placed.surface().has_ellipsoid()) {
    throw Failure(ExitCode::kUsage, "surface " + placed.name() +
                                        " is not an ellipsoid, and this format shows no other surface; choose one of "
                                        "motion alone, such as stride, or solve without exponents of the feet");
  }
  return {kind,
          placed.name(),
          placed.joint(),
          ToVector(placed.center_m()),
          ToRotation(placed.orientation()),
          ToVector(placed.surface().ellipsoid().semi_axes_m())};
}

// A homogeneous ellipsoid has the moments m (b² + c²)/5 ….
LinkShape InertiaEllipsoid(const v1::Model& model, int joint) {
  const LinkMass body = MassOf(model.joints(joint));
  const auto [moments, axes] = PrincipalAxesOf(body.inertia);
  Eigen::Vector3d semi_axes;
  for (int k = 0; k < 3; ++k) {
    semi_axes(k) = std::sqrt(std::max(0.0, 2.5 / body.mass * (moments.sum() - 2 * moments(k))));
  }
  return {LinkShape::Kind::kInertia,
          model.joints(joint).link_name() + "_inertia",
          joint,
          body.center_of_mass,
          axes,
          semi_axes};
}

}  // namespace

std::vector<LinkShape> LinkShapes(const v1::Model& model) {
  std::vector<LinkShape> shapes;
  for (const v1::ContactSurface& contact : model.contacts()) {
    shapes.push_back(ShapeOf(LinkShape::Kind::kContact, contact, model));
  }
  const size_t contacts = shapes.size();
  for (const v1::BodySurface& body : model.bodies()) {
    const bool known = std::any_of(shapes.begin(), shapes.begin() + contacts,
                                   [&body](const LinkShape& shape) { return shape.name == body.name(); });
    if (!known) shapes.push_back(ShapeOf(LinkShape::Kind::kBody, body, model));
  }
  for (int i = 0; i < model.joints_size(); ++i) {
    const bool shown =
        std::any_of(shapes.begin(), shapes.end(), [i](const LinkShape& shape) { return shape.joint == i; });
    if (model.joints(i).mass_kg() > 0 && !shown) shapes.push_back(InertiaEllipsoid(model, i));
  }
  return shapes;
}

}  // namespace rollgait::client
