#include "server/convert/model_convert.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/flattened_superellipsoid.h"
#include "core/models/foot.h"
#include "server/convert/surface_convert.h"

namespace rollgait::server {
namespace {

Vector3 Decode(const v1::Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Matrix3 Decode(const v1::Quaternion& q) { return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).toRotationMatrix(); }

// A joint read back from the message alone.
Joint Decode(const v1::Joint& encoded) {
  Joint joint;
  joint.name = encoded.name();
  joint.type = encoded.type() == v1::Joint::TYPE_PRISMATIC ? JointType::kPrismatic : JointType::kRevolute;
  joint.parent = encoded.parent();
  joint.p_PJ = Decode(encoded.origin_m());
  joint.R_PJ = Decode(encoded.orientation());
  joint.axis = Decode(encoded.axis());
  joint.position_min = encoded.position_min();
  joint.position_max = encoded.position_max();
  joint.velocity_max = encoded.velocity_max();
  joint.actuated = encoded.actuated();
  joint.effort_min = encoded.effort_min();
  joint.effort_max = encoded.effort_max();
  joint.link = encoded.link_name();
  joint.mass = encoded.mass_kg();
  joint.center_of_mass = Decode(encoded.center_of_mass_m());
  const auto& i = encoded.inertia_kg_m2();
  joint.inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  joint.mirror_joint = encoded.mirror_joint();
  joint.mirror_sign = encoded.mirror_sign();
  return joint;
}

void ExpectSameJoint(const Joint& a, const Joint& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.p_PJ, b.p_PJ);
  EXPECT_LT((a.R_PJ - b.R_PJ).norm(), 1e-14) << "rotation -> quaternion -> rotation, rounding";
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.position_min, b.position_min);
  EXPECT_EQ(a.position_max, b.position_max);
  EXPECT_EQ(a.velocity_max, b.velocity_max);
  EXPECT_EQ(a.actuated, b.actuated);
  EXPECT_EQ(a.effort_min, b.effort_min);
  EXPECT_EQ(a.effort_max, b.effort_max);
  EXPECT_EQ(a.link, b.link);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.center_of_mass, b.center_of_mass);
  EXPECT_EQ(a.inertia, b.inertia);
  EXPECT_EQ(a.mirror_sign, b.mirror_sign);
}

Scene Planar() {
  BodyRequest body;
  body.model = "planar";
  body.stature = 1.9;
  return BuildScene(body).value();
}

TEST(EncodeModel, TheTreeCanBeRebuiltFromTheMessage) {
  const Scene scene = Planar();
  v1::Model encoded;
  ASSERT_TRUE(encoded.ParseFromString(EncodeModel(scene, 9.81).SerializeAsString()));
  std::vector<Joint> joints;
  for (const v1::Joint& joint : encoded.joints()) joints.push_back(Decode(joint));
  const Result<Model> model = Model::Create(std::move(joints));
  ASSERT_TRUE(model.ok()) << model.violations()[0].field << model.violations()[0].message;
  ASSERT_EQ(model.value().size(), scene.model.size());
  for (int i = 0; i < scene.model.size(); ++i) {
    SCOPED_TRACE(i);
    ExpectSameJoint(model.value().joint(i), scene.model.joint(i));
    const int mirror = scene.model.joint(i).mirror_joint;
    EXPECT_EQ(encoded.joints(i).mirror_joint(), mirror < 0 ? i : mirror);
  }
  EXPECT_EQ(model.value().total_mass(), encoded.total_mass_kg());
}

// The catalogue has no turned joint frame yet.
TEST(EncodeModel, KeepsTurnedFramesAndEveryEntryOfTheInertia) {
  Joint joint;
  joint.name = "only";
  joint.link = "link";
  joint.mass = 2;
  joint.R_PJ = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  joint.inertia << 5, 0.1, 0.2, 0.1, 6, 0.3, 0.2, 0.3, 7;
  joint.mirror_sign = -1;
  Scene scene = Planar();
  Result<Model> model = Model::Create({joint});
  ASSERT_TRUE(model.ok()) << model.violations()[0].message;
  scene.model = std::move(model).value();
  scene.contacts.clear();
  ExpectSameJoint(Decode(EncodeModel(scene, 9.81).joints(0)), joint);
}

TEST(EncodeModel, ContactsNameTheirSurfaceAndMirror) {
  const Scene scene = Planar();
  const v1::Model encoded = EncodeModel(scene, 3.7);
  ASSERT_EQ(encoded.contacts_size(), 2);
  for (int i = 0; i < 2; ++i) {
    const ContactSurface& contact = scene.contacts[i];
    EXPECT_EQ(encoded.contacts(i).name(), contact.name);
    EXPECT_EQ(encoded.contacts(i).joint(), contact.joint);
    EXPECT_EQ(Decode(encoded.contacts(i).surface().ellipsoid().semi_axes_m()),
              contact.surface.ellipsoid()->semi_axes());
    EXPECT_EQ(Decode(encoded.contacts(i).center_m()), contact.p_LE);
    EXPECT_LT((Decode(encoded.contacts(i).orientation()) - contact.R_LE).norm(), 1e-14);
    EXPECT_EQ(encoded.contacts(i).mirror_contact(), scene.contacts[1 - i].name);
    ASSERT_EQ(encoded.contacts(i).directions_size(), 2);
    EXPECT_EQ(Decode(encoded.contacts(i).directions(0)), Vector3::UnitX());
    EXPECT_EQ(Decode(encoded.contacts(i).directions(1)), Vector3::UnitZ());
  }
  EXPECT_EQ(encoded.gravity_m_s2(), 3.7);
  EXPECT_EQ(encoded.stature_m(), 1.9);
  EXPECT_EQ(encoded.selection().stature_m(), 1.9);
  EXPECT_EQ(encoded.selection().sex(), v1::ModelSelection::SEX_MALE);
  EXPECT_EQ(encoded.leg_length_m(), scene.leg_length);
  EXPECT_EQ(encoded.sources_size(), static_cast<int>(scene.sources.size()));
}

// Who reads the message alone can place every body and knows which must keep apart.
TEST(EncodeModel, BodiesAndThePairsThatCanMeet) {
  BodyRequest body;
  body.model = "human29";
  body.toes = true;
  const Scene scene = BuildScene(body).value();
  const v1::Model encoded = EncodeModel(scene, 9.81);
  ASSERT_EQ(encoded.bodies_size(), 12);
  for (int i = 0; i < encoded.bodies_size(); ++i) {
    const BodySurface& from = scene.bodies[i];
    EXPECT_EQ(encoded.bodies(i).name(), from.name);
    EXPECT_EQ(encoded.bodies(i).joint(), from.joint);
    EXPECT_EQ(Decode(encoded.bodies(i).surface().ellipsoid().semi_axes_m()),
              from.placed.surface.ellipsoid()->semi_axes());
    EXPECT_EQ(Decode(encoded.bodies(i).center_m()), from.placed.p_BE);
    EXPECT_LT((Decode(encoded.bodies(i).orientation()) - from.placed.R_BE).norm(), 1e-14);
    EXPECT_EQ(encoded.bodies(i).mirror_body(), scene.bodies[from.mirror_body].name);
  }
  ASSERT_EQ(encoded.body_pairs_size(), static_cast<int>(scene.pairs.size()));
  ASSERT_GT(encoded.body_pairs_size(), 20);
  for (int i = 0; i < encoded.body_pairs_size(); ++i) {
    EXPECT_EQ(encoded.body_pairs(i).first() + " / " + encoded.body_pairs(i).second(), scene.PairName(i));
  }
  const v1::Model planar = EncodeModel(Planar(), 9.81);
  EXPECT_EQ(planar.bodies_size(), 8);
  EXPECT_EQ(planar.body_pairs_size(), 0);
}

TEST(EncodeSummary, IsTheSameForTheCatalogueAndTheModel) {
  for (const CatalogEntry& entry : ListCatalog()) {
    BodyRequest body;
    body.model = entry.name;
    EXPECT_EQ(EncodeSummary(entry).SerializeAsString(),
              EncodeModel(BuildScene(body).value(), 9.81).summary().SerializeAsString());
    EXPECT_GT(EncodeSummary(entry).degrees_of_freedom(), 0);
  }
}

// A superellipsoid arrives with everything that makes its shape, and is read back as it was.
TEST(EncodeModel, TellsTheSuperellipsoidsOfFeet) {
  BodyRequest body;
  body.model = "planar";
  body.changes.foot_exponents = {{"foot", 0.8}};
  const Scene scene = BuildScene(body).value();
  const v1::Model encoded = EncodeModel(scene, 9.81);
  const v1::Surface& surface = encoded.contacts(0).surface();
  ASSERT_TRUE(surface.has_superellipsoid());
  EXPECT_EQ(Decode(surface.superellipsoid().semi_axes_m()), *scene.contacts[0].surface.semi_axes());
  EXPECT_EQ(surface.superellipsoid().exponent_1(), 0.8);
  EXPECT_EQ(surface.superellipsoid().exponent_2(), 0.8);
  EXPECT_EQ(surface.superellipsoid().smoothing(), kFootSmoothing);
  EXPECT_EQ(surface.superellipsoid().flattening(), 0);
  Violations violations;
  const std::optional<Surface> back = DecodeSurface("surface", surface, &violations);
  ASSERT_TRUE(back && violations.empty());
  const Matrix3 none = Matrix3::Identity();
  EXPECT_EQ(SupportDifference(*back, none, scene.contacts[0].surface, none), 0);
}

// Models that walk have ellipsoids and smooth superellipsoids only; the others must not end a server either.
TEST(EncodeSurface, EveryKindIsReadBackAsItWas) {
  const Vector3 axes(0.12, 0.05, 0.04);
  const std::vector<Surface> surfaces = {Ellipsoid(axes), Surface(Ellipsoid(axes)).Rounded(0.02), Sphere(0.05),
                                         Superellipsoid(axes, 0.7, 1.2),
                                         Surface(SmoothSuperellipsoid(axes, 0.7, 1.2, 0.2)).Rounded(0.01)};
  const Matrix3 none = Matrix3::Identity();
  for (const Surface& surface : surfaces) {
    v1::Surface encoded;
    EncodeSurface(surface, &encoded);
    Violations violations;
    const std::optional<Surface> back = DecodeSurface("surface", encoded, &violations);
    ASSERT_TRUE(back && violations.empty()) << encoded.ShortDebugString();
    EXPECT_EQ(back->kind().index(), surface.kind().index());
    EXPECT_EQ(back->rounding(), surface.rounding());
    EXPECT_EQ(SupportDifference(*back, none, surface, none), 0);
  }
}

TEST(EncodeSurface, WhatNoMessageSaysHasNoShape) {
  v1::Surface encoded;
  encoded.mutable_sphere()->set_radius_m(1);
  EncodeSurface(FlattenedSuperellipsoid::Create(Vector3(0.1, 0.1, 0.1), 0.5, 0.5, 0.1).value(), &encoded);
  EXPECT_EQ(encoded.shape_case(), v1::Surface::SHAPE_NOT_SET);
  EncodeSurface(Surface(Sphere(1)).MovedTo(Vector3(0, 0, 0.1)), &encoded);
  EXPECT_EQ(encoded.shape_case(), v1::Surface::SHAPE_NOT_SET);
}

// A shape that the proto has is known to the decoder under its name there.
TEST(DecodeSurface, KnowsEveryShape) {
  const auto* const shapes = v1::Surface::descriptor()->FindOneofByName("shape");
  ASSERT_GE(shapes->field_count(), 3);
  for (int i = 0; i < shapes->field_count(); ++i) {
    const auto& field = *shapes->field(i);
    v1::Surface surface;
    auto* const shape = surface.GetReflection()->MutableMessage(&surface, &field);
    for (int k = 0; k < field.message_type()->field_count(); ++k) {
      const auto& number = *field.message_type()->field(k);
      if (number.message_type() == nullptr) shape->GetReflection()->SetDouble(shape, &number, -1);
    }
    Violations violations;
    EXPECT_FALSE(DecodeSurface("body", surface, &violations)) << field.name();
    ASSERT_FALSE(violations.empty());
    EXPECT_EQ(violations[0].field.rfind("body." + std::string(field.name()) + ".", 0), 0u) << violations[0].field;
  }
  Violations violations;
  EXPECT_FALSE(DecodeSurface("body", v1::Surface(), &violations));
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field, "body");
  EXPECT_EQ(violations[0].message.rfind("is not set; give an ellipsoid, a sphere, a superellipsoid", 0), 0u)
      << violations[0].message;
}

TEST(DecodeSurface, RefusesSmoothingBesideFlattening) {
  v1::Surface surface;
  v1::Superellipsoid& super = *surface.mutable_superellipsoid();
  super.mutable_semi_axes_m()->set_x(1), super.mutable_semi_axes_m()->set_y(1), super.mutable_semi_axes_m()->set_z(1);
  super.set_exponent_1(0.8), super.set_exponent_2(0.8), super.set_flattening(0.1), super.set_smoothing(0.1);
  Violations violations;
  EXPECT_FALSE(DecodeSurface("body", surface, &violations));
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field, "body.superellipsoid.smoothing");
  EXPECT_EQ(violations[0].message, "is set together with flattening; give one of the two");
  super.set_flattening(0), super.set_smoothing(-1);
  violations.clear();
  EXPECT_FALSE(DecodeSurface("body", surface, &violations));
  EXPECT_EQ(violations[0].message, "The smoothing is -1; it must lie in 0.01 … 1.");
}

// What comes back selects the same body again.
TEST(EncodeModel, SelectionNamesTheReductions) {
  BodyRequest body;
  body.model = "human29";
  body.toes = true;
  body.rigid_trunk = true;
  body.segment_lengths = {{"thigh", 0.45}};
  body.locked_joints = {{"elbow_l", 0.3}, {"elbow_r", 0.3}};
  body.changes.loads = {{.segment = "thigh_l", .mass = 2, .position = Vector3(0.1, 0.2, 0.3), .moments = {1, 1, 1}},
                        {.segment = "pelvis", .mass = 3, .position = {}}};
  body.changes.strengths = {{"knee_l", 0.5}};
  body.changes.springs = {{"ankle_r", {300, 0.1, 2}}};
  body.changes.foot_semi_axes = {{"heel_l", Vector3(0.035, 0.03, 0.02)}};
  body.changes.foot_exponents = {{"heel_l", 0.8}};
  const v1::ModelSelection selection = EncodeModel(BuildScene(body).value(), 9.81).selection();
  EXPECT_EQ(selection.feet(), v1::ModelSelection::FEET_TWO_ELLIPSOIDS);
  EXPECT_TRUE(selection.toes() && selection.rigid_trunk());
  EXPECT_FALSE(selection.sagittal() || selection.drop_arms());
  EXPECT_EQ(selection.segment_lengths_m().at("thigh"), 0.45);
  EXPECT_EQ(selection.locked_joints_rad().at("elbow_r"), 0.3);
  EXPECT_EQ(selection.locked_joints_rad().size(), 2u);
  ASSERT_EQ(selection.loads_size(), 2);
  EXPECT_EQ(selection.loads(0).segment(), "thigh_l");
  EXPECT_EQ(selection.loads(0).mass_kg(), 2);
  EXPECT_EQ(selection.loads(0).position_m().y(), 0.2);
  EXPECT_EQ(selection.loads(0).moments_kg_m2().z(), 1);
  EXPECT_FALSE(selection.loads(1).has_position_m() || selection.loads(1).has_moments_kg_m2());
  EXPECT_EQ(selection.joint_strengths().at("knee_l"), 0.5);
  EXPECT_EQ(selection.foot_semi_axes_m().at("heel_l").x(), 0.035);
  EXPECT_EQ(selection.foot_semi_axes_m().at("heel_l").z(), 0.02);
  EXPECT_EQ(selection.foot_exponents().at("heel_l"), 0.8);
  EXPECT_EQ(selection.joint_springs().at("ankle_r").stiffness_n_m_rad(), 300);
  EXPECT_EQ(selection.joint_springs().at("ankle_r").rest_rad(), 0.1);
  EXPECT_EQ(selection.joint_springs().at("ankle_r").damping_n_m_s_rad(), 2);
}

}  // namespace
}  // namespace rollgait::server
