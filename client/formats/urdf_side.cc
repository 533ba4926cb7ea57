#include "client/formats/urdf_side.h"

#include <algorithm>
#include <cmath>

#include "client/failure.h"
#include "client/formats/urdf.h"
#include "client/joint_kinds.h"
#include "client/json.h"

namespace rollgait::client {
namespace {

template <typename From, typename To>
void SetPart(const v1::Model& model, const From& from, To* to) {
  if (from.joint() < 0 || from.joint() >= model.joints_size()) {
    throw Failure(ExitCode::kUsage, "part \"" + from.name() + "\" of the model is on joint " +
                                        std::to_string(from.joint()) + ", which it does not have");
  }
  to->set_name(from.name());
  to->set_link(model.joints(from.joint()).link_name());
  *to->mutable_surface() = from.surface();
  *to->mutable_center_m() = from.center_m();
  if (from.has_orientation()) *to->mutable_orientation() = from.orientation();
}

}  // namespace

v1::ModelSideFile SideFileOfModel(const v1::Model& model) {
  v1::ModelSideFile side;
  side.set_name(model.summary().name());
  side.set_description(model.summary().description());
  const int most_sources = 40;
  for (int i = 0; i < std::min(model.sources_size(), most_sources); ++i) side.add_sources(model.sources(i));
  side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& from = model.joints(i);
    if (from.mirror_joint() != i || from.mirror_sign() < 0) side.set_mirror(v1::ModelSideFile::MIRROR_PROPOSED);
  }
  for (const v1::Joint& from : model.joints()) {
    v1::SideJoint& to = *side.add_joints();
    to.set_name(from.name());
    to.set_role(from.role());
    to.set_side(from.side());
    to.set_passive(from.passive());
    to.set_actuated(from.actuated());
    // What URDF states otherwise: one effort for both directions, a number for none.
    if (from.actuated() && (from.effort_min() != -from.effort_max() || from.effort_max() > kUrdfUnlimited)) {
      to.set_effort_min(from.effort_min());
      to.set_effort_max(from.effort_max());
    }
    if (from.stiffness() != 0) {
      to.set_stiffness(from.stiffness());
      to.set_rest_position(from.rest_position());
    }
    if (from.velocity_max() > kUrdfUnlimited && std::isfinite(from.velocity_max())) {
      to.set_velocity_max(from.velocity_max());
    }
    if (side.mirror() == v1::ModelSideFile::MIRROR_PROPOSED && from.mirror_joint() >= 0 &&
        from.mirror_joint() < model.joints_size()) {
      to.set_mirror_joint(model.joints(from.mirror_joint()).name());
      to.set_mirror_sign(from.mirror_sign());
    }
  }
  for (const v1::ContactSurface& from : model.contacts()) {
    v1::SideContact& to = *side.add_contacts();
    SetPart(model, from, &to);
    to.set_mirror_contact(from.mirror_contact());
    to.set_side(from.side());
    to.set_part(from.part());
  }
  for (const v1::BodySurface& from : model.bodies()) {
    v1::SideBody& to = *side.add_bodies();
    SetPart(model, from, &to);
    to.set_mirror_body(from.mirror_body());
  }
  *side.mutable_body_pairs() = model.body_pairs();
  side.set_leg_length_m(model.leg_length_m());
  return side;
}

std::string ToUrdfSide(const v1::Model& model) {
  for (int i = 0; i < model.joints_size(); ++i) RequireTurnOrSlide(model.joints(i), i);  // of a URDF that there is
  return ToJsonText(SideFileOfModel(model));
}

}  // namespace rollgait::client
