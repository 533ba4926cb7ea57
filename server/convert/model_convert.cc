#include "server/convert/model_convert.h"

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "server/convert/joint_chains.h"
#include "server/convert/joint_convert.h"
#include "server/convert/surface_convert.h"

namespace rollgait::server {
namespace {

void EncodeVector(const Vector3& vector, v1::Vector3* encoded) {
  encoded->set_x(vector.x());
  encoded->set_y(vector.y());
  encoded->set_z(vector.z());
}

void EncodeRotation(const Matrix3& rotation, v1::Quaternion* encoded) {
  const Eigen::Quaterniond q(rotation);
  encoded->set_w(q.w());
  encoded->set_x(q.x());
  encoded->set_y(q.y());
  encoded->set_z(q.z());
}

v1::BodySide EncodeSide(BodySide side) {
  switch (side) {
    case BodySide::kMidline:
      return v1::BODY_SIDE_UNSPECIFIED;
    case BodySide::kLeft:
      return v1::BODY_SIDE_LEFT;
    case BodySide::kRight:
      return v1::BODY_SIDE_RIGHT;
  }
  ROLLGAIT_CHECK(false);
}

void EncodeJoint(const Joint& joint, int index, v1::Joint* encoded) {
  encoded->set_name(joint.name);
  encoded->set_type(EncodeJointType(joint.type));
  encoded->set_parent(joint.parent);
  EncodeVector(joint.p_PJ, encoded->mutable_origin_m());
  EncodeRotation(joint.R_PJ, encoded->mutable_orientation());
  EncodeVector(joint.axis, encoded->mutable_axis());
  EncodeJointNumbers(joint, encoded);
  encoded->set_actuated(joint.actuated);
  encoded->set_link_name(joint.link);
  EncodeVector(joint.center_of_mass, encoded->mutable_center_of_mass_m());
  const Matrix3& inertia = joint.inertia;
  for (const double entry :
       {inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2)}) {
    encoded->add_inertia_kg_m2(entry);
  }
  encoded->set_mirror_joint(joint.mirror_joint < 0 ? index : joint.mirror_joint);
  encoded->set_mirror_sign(joint.mirror_sign);
  // The numbers are the same; tests hold every one.
  encoded->set_role(static_cast<v1::Joint::Role>(joint.role));
  encoded->set_side(EncodeSide(joint.side));
  encoded->set_passive(static_cast<v1::Joint::Passive>(joint.passive));
}

void EncodeContact(const ContactSurface& contact, const Scene& scene, v1::ContactSurface* encoded) {
  encoded->set_name(contact.name);
  encoded->set_joint(contact.joint);
  EncodeSurface(contact.surface, encoded->mutable_surface());
  EncodeVector(contact.p_LE, encoded->mutable_center_m());
  EncodeRotation(contact.R_LE, encoded->mutable_orientation());
  encoded->set_mirror_contact(scene.contacts[contact.mirror_contact].name);
  for (const int direction : contact.directions) {
    EncodeVector(Vector3::Unit(direction), encoded->add_directions());
  }
  encoded->set_side(EncodeSide(contact.side));
  encoded->set_part(static_cast<v1::ContactSurface::FootPart>(contact.part));
}

void EncodeBody(const BodySurface& body, const Scene& scene, v1::BodySurface* encoded) {
  encoded->set_name(body.name);
  encoded->set_joint(body.joint);
  EncodeSurface(body.placed.surface, encoded->mutable_surface());
  EncodeVector(body.placed.p_BE, encoded->mutable_center_m());
  EncodeRotation(body.placed.R_BE, encoded->mutable_orientation());
  encoded->set_mirror_body(scene.bodies[body.mirror_body].name);
}

void EncodeChanges(const SubjectChanges& changes, v1::ModelSelection* encoded) {
  for (const SegmentLoad& load : changes.loads) {
    v1::ModelSelection::Load& added = *encoded->add_loads();
    added.set_segment(load.segment);
    added.set_mass_kg(load.mass);
    if (load.position) EncodeVector(*load.position, added.mutable_position_m());
    if (!load.moments.isZero(0)) EncodeVector(load.moments, added.mutable_moments_kg_m2());
  }
  encoded->mutable_joint_strengths()->insert(changes.strengths.begin(), changes.strengths.end());
  for (const auto& [name, spring] : changes.springs) {
    v1::ModelSelection::JointSpring& added = (*encoded->mutable_joint_springs())[name];
    added.set_stiffness_n_m_rad(spring.stiffness);
    added.set_rest_rad(spring.rest);
    added.set_damping_n_m_s_rad(spring.damping);
  }
  for (const auto& [name, axes] : changes.foot_semi_axes) {
    EncodeVector(axes, &(*encoded->mutable_foot_semi_axes_m())[name]);
  }
  encoded->mutable_foot_exponents()->insert(changes.foot_exponents.begin(), changes.foot_exponents.end());
}

void EncodeSelection(const BodySelection& selection, v1::ModelSelection* encoded) {
  encoded->set_name(selection.model);
  if (selection.rolling_body) {
    v1::RollingBody& body = *encoded->mutable_rolling_body();
    EncodeVector(selection.rolling_body->semi_axes, body.mutable_semi_axes_m());
    body.set_mass_kg(selection.rolling_body->mass);
    EncodeVector(selection.rolling_body->moments, body.mutable_moments_kg_m2());
    return;
  }
  encoded->set_sex(selection.sex == Sex::kFemale ? v1::ModelSelection::SEX_FEMALE : v1::ModelSelection::SEX_MALE);
  encoded->set_stature_m(selection.stature);
  encoded->set_body_mass_kg(selection.mass);
  encoded->mutable_segment_lengths_m()->insert(selection.segment_lengths.begin(), selection.segment_lengths.end());
  EncodeChanges(selection.changes, encoded);
  encoded->set_feet(selection.feet == FootShape::kTwoEllipsoids ? v1::ModelSelection::FEET_TWO_ELLIPSOIDS
                                                                : v1::ModelSelection::FEET_ONE_ELLIPSOID);
  encoded->set_toes(selection.toes);
  encoded->set_ranges(selection.ranges == JointRanges::kWalking ? v1::ModelSelection::RANGES_WALKING
                                                                : v1::ModelSelection::RANGES_ANATOMICAL);
  encoded->set_sagittal(selection.sagittal);
  encoded->set_drop_arms(selection.drop_arms);
  encoded->set_rigid_trunk(selection.rigid_trunk);
  encoded->mutable_locked_joints_rad()->insert(selection.locked_joints.begin(), selection.locked_joints.end());
}

}  // namespace

v1::ModelSummary EncodeSummary(const CatalogEntry& entry) {
  v1::ModelSummary summary;
  summary.set_name(entry.name);
  summary.set_description(entry.description);
  summary.set_degrees_of_freedom(entry.degrees_of_freedom);
  summary.set_actuated_joints(entry.actuated_joints);
  for (const std::string& contact : entry.contacts) summary.add_contact_names(contact);
  return summary;
}

v1::Model EncodeModel(const Scene& scene, double gravity, JointForm form) {
  v1::Model model;
  CatalogEntry entry{
      scene.name, scene.description, scene.model.size(), static_cast<int>(scene.model.actuated().size()), {}};
  for (const ContactSurface& contact : scene.contacts) entry.contacts.push_back(contact.name);
  *model.mutable_summary() = EncodeSummary(entry);
  const bool own = scene.selection.own;
  if (!own) EncodeSelection(scene.selection, model.mutable_selection());
  for (int i = 0; i < scene.model.size(); ++i) EncodeJoint(scene.model.joint(i), i, model.add_joints());
  for (const ContactSurface& contact : scene.contacts) EncodeContact(contact, scene, model.add_contacts());
  for (const BodySurface& body : scene.bodies) EncodeBody(body, scene, model.add_bodies());
  for (const BodyPair& pair : scene.pairs) {
    v1::BodyPair& encoded = *model.add_body_pairs();
    encoded.set_first(scene.bodies[pair.first].name);
    encoded.set_second(scene.bodies[pair.second].name);
    encoded.set_usual(pair.usual);
  }
  model.set_gravity_m_s2(gravity);
  model.set_total_mass_kg(scene.model.total_mass());
  if (!scene.selection.rolling_body && !own) model.set_stature_m(scene.selection.stature);
  model.set_leg_length_m(scene.leg_length);
  for (const std::string& source : scene.sources) model.add_sources(source);
  if (form == JointForm::kAsGiven) return FoldJointChains(model, scene.chains);
  return model;
}

}  // namespace rollgait::server
