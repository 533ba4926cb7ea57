#include <optional>
#include <sstream>
#include <variant>

#include "core/geometry/flattened_superellipsoid.h"
#include "server/convert/scene_decoding.h"

namespace rollgait::server {
namespace {

constexpr double kPointRadius = 1e-15;  // m; a sphere of radius 0 is computed as one of this radius
constexpr double kMaxRadius = 1e6;      // m

class ContactDecoder {
 public:
  explicit ContactDecoder(SceneDecoding* decoding) : decoding_(*decoding) {}
  SceneContact Decode(const v1::SceneContact& encoded, int k);

 private:
  Surface DecodeSurface(const std::string& field, const v1::Surface& surface);
  // Nothing if it was refused.
  std::optional<Surface> DecodeSuperellipsoid(const std::string& field, const v1::Superellipsoid& shape);
  void RefuseAxes(const std::string& field, const Vector3& axes);
  rollgait::PlacedSurface DecodePlaced(const std::string& field, const v1::PlacedSurface& placed);
  void DecodeOther(const std::string& path, const v1::SceneContact& encoded, TreeContact* contact);

  SceneDecoding& decoding_;
};

Surface ContactDecoder::DecodeSurface(const std::string& field, const v1::Surface& surface) {
  std::optional<Surface> decoded;
  switch (surface.shape_case()) {
    case v1::Surface::kEllipsoid: {
      const Vector3 axes = DecodeVector(surface.ellipsoid().semi_axes_m());
      if (axes.allFinite() && axes.minCoeff() > 0 && axes.maxCoeff() <= kMaxRadius) {
        decoded = Ellipsoid(axes);
      } else {
        RefuseAxes(field + ".ellipsoid.semi_axes_m", axes);
      }
      break;
    }
    case v1::Surface::kSphere: {
      const double radius = surface.sphere().radius_m();
      if (radius >= 0 && radius <= kMaxRadius) {
        decoded = Sphere(radius > 0 ? radius : kPointRadius);
      } else {
        decoding_.Refuse(field + ".sphere.radius_m", "is " + std::to_string(radius) + "; must be within [0, 1e6] m");
      }
      break;
    }
    case v1::Surface::kSuperellipsoid: {
      decoded = DecodeSuperellipsoid(field + ".superellipsoid", surface.superellipsoid());
      break;
    }
    case v1::Surface::SHAPE_NOT_SET:
      decoding_.Refuse(field, "is not set; give an ellipsoid, a sphere or a superellipsoid");
  }
  if (!(surface.rounding_m() >= 0 && surface.rounding_m() <= kMaxRadius)) {
    decoding_.Refuse(field + ".rounding_m",
                     "is " + std::to_string(surface.rounding_m()) + "; must be within [0, 1e6] m");
    return Sphere(1);
  }
  if (!decoded) return Sphere(1);
  return surface.rounding_m() > 0 ? decoded->Rounded(surface.rounding_m()) : *decoded;
}

std::optional<Surface> ContactDecoder::DecodeSuperellipsoid(const std::string& field, const v1::Superellipsoid& shape) {
  const Vector3 axes = DecodeVector(shape.semi_axes_m());
  const auto take = [&](const auto& created) -> std::optional<Surface> {
    if (created.ok()) return Surface(created.value());
    for (const Violation& violation : created.violations()) decoding_.Refuse(violation.field, violation.message);
    return std::nullopt;
  };
  if (shape.flattening() == 0) return take(Superellipsoid::Create(axes, shape.exponent_1(), shape.exponent_2(), field));
  return take(FlattenedSuperellipsoid::Create(axes, shape.exponent_1(), shape.exponent_2(), shape.flattening(), field));
}

void ContactDecoder::RefuseAxes(const std::string& field, const Vector3& axes) {
  std::ostringstream message;
  message << "is " << axes.transpose() << "; every semi-axis must be larger than 0 and at most 1e6 m";
  decoding_.Refuse(field, message.str());
}

rollgait::PlacedSurface ContactDecoder::DecodePlaced(const std::string& field, const v1::PlacedSurface& placed) {
  rollgait::PlacedSurface decoded;
  decoded.surface = DecodeSurface(field + ".surface", placed.surface());
  decoded.p_BE = decoding_.Point(field + ".center_m", placed.center_m());
  decoded.R_BE =
      decoding_.Rotation(field + ".orientation", placed.has_orientation(), placed.orientation()).toRotationMatrix();
  return decoded;
}

void ContactDecoder::DecodeOther(const std::string& path, const v1::SceneContact& encoded, TreeContact* contact) {
  switch (encoded.other_case()) {
    case v1::SceneContact::kPlane: {
      const v1::PlacedPlane& plane = encoded.plane();
      if (!plane.joint().empty() && !plane.ground().empty()) {
        decoding_.Refuse(path + "plane.ground", "is set together with plane.joint; a plane is fixed to one of the two");
      }
      if (!plane.joint().empty()) contact->other_link = decoding_.Joint(path + "plane.joint", plane.joint());
      if (!plane.ground().empty()) {
        contact->ground = decoding_.Ground(path + "plane.ground", plane.ground());
      }
      contact->other = rollgait::PlacedPlane{
          decoding_.Point(path + "plane.point_m", plane.point_m()),
          decoding_.Direction(path + "plane.normal", plane.has_normal(), plane.normal(), Vector3::UnitZ())};
      break;
    }
    case v1::SceneContact::kOtherBody:
      if (!encoded.other_body().joint().empty()) {
        contact->other_link = decoding_.Joint(path + "other_body.joint", encoded.other_body().joint());
      }
      contact->other = DecodePlaced(path + "other_body", encoded.other_body());
      break;
    case v1::SceneContact::OTHER_NOT_SET:
      contact->other = rollgait::PlacedPlane{};  // z = 0 of the world
  }
  if (contact->other_link == contact->link) {
    decoding_.Refuse(path + (encoded.has_plane() ? "plane.joint" : "other_body.joint"),
                     "is the joint of the contact's own body; a body does not touch itself");
  }
}

SceneContact ContactDecoder::Decode(const v1::SceneContact& encoded, int k) {
  const std::string path = "contacts[" + std::to_string(k) + "].";
  SceneContact decoded;
  TreeContact& contact = decoded.contact;
  contact.name = encoded.name();
  contact.link = decoding_.Joint(path + "body.joint", encoded.body().joint());
  contact.surface = DecodePlaced(path + "body", encoded.body());
  DecodeOther(path, encoded, &contact);
  switch (encoded.grip()) {
    case v1::SceneContact::GRIP_UNSPECIFIED:
    case v1::SceneContact::GRIP_ROLLING:
      contact.grip = Grip::kRolling;
      break;
    case v1::SceneContact::GRIP_ROLLING_ALONG:
      contact.grip = Grip::kRollingAlong;
      break;
    case v1::SceneContact::GRIP_FRICTIONLESS:
      contact.grip = Grip::kFrictionless;
      break;
    default:
      decoding_.Refuse(path + "grip",
                       "enum value " + std::to_string(encoded.grip()) + " is not known; use a named one");
  }
  contact.along = decoding_.Direction(path + "along", encoded.has_along(), encoded.along(), Vector3::UnitX());
  const auto* plane = std::get_if<rollgait::PlacedPlane>(&contact.other);
  if (contact.grip == Grip::kRollingAlong && plane != nullptr && contact.along.cross(plane->n_B).norm() < 1e-6) {
    decoding_.Refuse(path + "along", "lies along the plane's normal; it must have a tangential part");
  }
  contact.no_spin = encoded.no_spin();
  decoded.active = encoded.active();
  decoded.bilateral = encoded.bilateral();
  decoded.can_touch_down = !encoded.has_can_touch_down() || encoded.can_touch_down();
  if (encoded.has_friction()) decoded.friction = encoded.friction();
  switch (encoded.friction_loss()) {
    case v1::SceneContact::FRICTION_LOSS_UNSPECIFIED:
    case v1::SceneContact::FRICTION_LOSS_REPORT:
      break;
    case v1::SceneContact::FRICTION_LOSS_STOP:
      decoded.friction_loss = FrictionLoss::kStop;
      break;
    case v1::SceneContact::FRICTION_LOSS_SLIDE:
      decoded.friction_loss = FrictionLoss::kSlide;
      break;
    default:
      decoding_.Refuse(path + "friction_loss",
                       "enum value " + std::to_string(encoded.friction_loss()) + " is not known; use a named one");
  }
  for (int g = 0; g < encoded.gates_size(); ++g) {
    const v1::SceneContact::Gate& gate = encoded.gates(g);
    decoded.gates.push_back({decoding_.Joint(path + "gates[" + std::to_string(g) + "].joint", gate.joint()),
                             gate.has_min() ? gate.min() : -kInfinity, gate.has_max() ? gate.max() : kInfinity});
  }
  if (!encoded.mirror_contact().empty()) {
    decoded.mirror = decoding_.Contact(path + "mirror_contact", encoded.mirror_contact());
  }
  return decoded;
}

}  // namespace

SceneContact DecodeContact(const v1::SceneContact& contact, int k, SceneDecoding* decoding) {
  return ContactDecoder(decoding).Decode(contact, k);
}

}  // namespace rollgait::server
