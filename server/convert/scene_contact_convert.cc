#include <variant>

#include "server/convert/scene_decoding.h"

namespace rollgait::server {
namespace {

class ContactDecoder {
 public:
  explicit ContactDecoder(SceneDecoding* decoding) : decoding_(*decoding) {}
  SceneContact Decode(const v1::SceneContact& encoded, int k);

 private:
  rollgait::PlacedSurface DecodePlaced(const std::string& field, const v1::PlacedSurface& placed);
  void DecodeOther(const std::string& path, const v1::SceneContact& encoded, TreeContact* contact);

  SceneDecoding& decoding_;
};

rollgait::PlacedSurface ContactDecoder::DecodePlaced(const std::string& field, const v1::PlacedSurface& placed) {
  rollgait::PlacedSurface decoded;
  decoded.surface = decoding_.Shape(field + ".surface", placed.surface());
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
