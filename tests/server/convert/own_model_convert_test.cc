// A model that was written is read back to the bit, and walks in a request.
#include "server/convert/own_model_convert.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"

namespace rollgait::server {
namespace {

v1::Model Written(const std::string& name) {
  BodyRequest body;
  body.model = name;
  return EncodeModel(BuildScene(body).value(), 9.81);
}

v1::Model ThroughJson(const v1::Model& model) {
  std::string text;
  EXPECT_TRUE(google::protobuf::util::MessageToJsonString(model, &text).ok());
  v1::Model read;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &read).ok());
  return read;
}

class OwnModelConvertTest : public ::testing::TestWithParam<const char*> {};

TEST_P(OwnModelConvertTest, ComesBackToTheBit) {
  v1::Model written = Written(GetParam());
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = ThroughJson(written);
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
  const v1::Model back = EncodeModel(checked.value().scene, 9.81);
  written.clear_selection();  // where it came from
  written.clear_stature_m();
  // JSON drops the sign of zeros, which axes have.
  EXPECT_EQ(ThroughJson(back).SerializeAsString(), ThroughJson(written).SerializeAsString());
  EXPECT_EQ(back.joints_size(), checked.value().scene.model.size());
}

INSTANTIATE_TEST_SUITE_P(Models, OwnModelConvertTest, ::testing::Values("planar", "human29"));

// The shanks of people move along the axis of the knee by some millimetres as it bends.
v1::Model WithScrews() {
  v1::Model model = Written("human29");
  model.clear_selection();
  model.clear_stature_m();
  for (v1::Joint& joint : *model.mutable_joints()) {
    if (joint.role() != v1::Joint::ROLE_KNEE_FLEXION) continue;
    joint.set_type(v1::Joint::TYPE_SCREW);
    joint.set_pitch_m_rad(joint.side() == v1::BODY_SIDE_LEFT ? 1e-3 / 3 : -1e-3 / 3);
  }
  return model;
}

TEST(OwnModelConvert, ScrewsComeBackToTheBit) {
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = ThroughJson(WithScrews());
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
  const v1::Model back = EncodeModel(checked.value().scene, 9.81);
  EXPECT_EQ(ThroughJson(back).SerializeAsString(), ThroughJson(WithScrews()).SerializeAsString());
  EXPECT_TRUE(checked.value().scene.symmetric);
}

// The mirror image of a screw is one of the opposite hand.
TEST(OwnModelConvert, ScrewsOfOneHandOnBothSidesAreRefused) {
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = WithScrews();
  for (v1::Joint& joint : *spec.mutable_model()->mutable_own()->mutable_joints()) {
    joint.set_pitch_m_rad(std::abs(joint.pitch_m_rad()));
  }
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.violations()[0].field.find("model.own.joints["), 0u);
  EXPECT_NE(checked.violations()[0].field.find("].pitch_m_rad"), std::string::npos) << checked.violations()[0].field;
}

TEST(OwnModelConvert, RolesArriveUnderTheirNames) {
  const v1::Model model = Written("human29");
  std::map<std::string, const v1::Joint*> joints;
  for (const v1::Joint& joint : model.joints()) joints[joint.name()] = &joint;
  EXPECT_EQ(joints["base_x"]->role(), v1::Joint::ROLE_BASE_FORWARD);
  EXPECT_EQ(joints["base_y"]->role(), v1::Joint::ROLE_BASE_LATERAL);
  EXPECT_EQ(joints["base_z"]->role(), v1::Joint::ROLE_BASE_VERTICAL);
  EXPECT_EQ(joints["base_yaw"]->role(), v1::Joint::ROLE_BASE_YAW);
  EXPECT_EQ(joints["base_roll"]->role(), v1::Joint::ROLE_BASE_ROLL);
  EXPECT_EQ(joints["base_pitch"]->role(), v1::Joint::ROLE_BASE_PITCH);
  EXPECT_EQ(joints["trunk_flexion"]->role(), v1::Joint::ROLE_TRUNK_FLEXION);
  EXPECT_EQ(joints["hip_l"]->role(), v1::Joint::ROLE_HIP_FLEXION);
  EXPECT_EQ(joints["hip_l"]->side(), v1::BODY_SIDE_LEFT);
  EXPECT_EQ(joints["hip_l"]->passive(), v1::Joint::PASSIVE_HUMAN_HIP);
  EXPECT_EQ(joints["knee_r"]->role(), v1::Joint::ROLE_KNEE_FLEXION);
  EXPECT_EQ(joints["knee_r"]->side(), v1::BODY_SIDE_RIGHT);
  EXPECT_EQ(joints["knee_r"]->passive(), v1::Joint::PASSIVE_HUMAN_KNEE);
  EXPECT_EQ(joints["ankle_r"]->role(), v1::Joint::ROLE_ANKLE_DORSIFLEXION);
  EXPECT_EQ(joints["ankle_r"]->passive(), v1::Joint::PASSIVE_HUMAN_ANKLE);
  EXPECT_EQ(joints["shoulder_l"]->role(), v1::Joint::ROLE_SHOULDER_FLEXION);
  EXPECT_EQ(joints["elbow_l"]->role(), v1::Joint::ROLE_ELBOW_FLEXION);
  EXPECT_EQ(joints["elbow_l"]->passive(), v1::Joint::PASSIVE_STOPS);
  EXPECT_EQ(model.contacts(0).part(), v1::ContactSurface::FOOT_PART_WHOLE);
}

struct Broken {
  const char* name;
  std::function<void(v1::ModelSelection*)> change;
  const char* field;
  const char* message;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenOwnModelTest : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenOwnModelTest, IsRefusedByPath) {
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = Written("planar");
  GetParam().change(spec.mutable_model());
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_FALSE(checked.ok());
  std::string said;
  bool found = false;
  for (const Violation& violation : checked.violations()) {
    said += violation.field + " " + violation.message + "\n";
    found = found ||
            (violation.field == GetParam().field && violation.message.find(GetParam().message) != std::string::npos);
  }
  EXPECT_TRUE(found) << said;
}

INSTANTIATE_TEST_SUITE_P(
    Models, BrokenOwnModelTest,
    ::testing::Values(
        Broken{"Empty", [](v1::ModelSelection* s) { s->mutable_own()->Clear(); }, "model.own.summary.name", "letters"},
        Broken{"AMillionLinks",
               [](v1::ModelSelection* s) {
                 for (int i = 0; i < 1000000; ++i) s->mutable_own()->add_joints();
               },
               "model.own.joints", "at most 64"},
        Broken{"OtherName", [](v1::ModelSelection* s) { s->set_name("human29"); }, "model.name", "own.summary.name"},
        Broken{"Stature", [](v1::ModelSelection* s) { s->set_stature_m(1.8); }, "model.stature_m", "leave it out"},
        Broken{"Type", [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->clear_type(); },
               "model.own.joints[3].type", "TYPE_REVOLUTE"},
        Broken{"Inertia", [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->add_inertia_kg_m2(1); },
               "model.own.joints[3].inertia_kg_m2", "must have 6"},
        Broken{"Quaternion",
               [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->mutable_orientation()->set_w(2); },
               "model.own.joints[3].orientation", "length 2"},
        Broken{"Role",
               [](v1::ModelSelection* s) {
                 s->mutable_own()->mutable_joints(3)->set_role(static_cast<v1::Joint::Role>(99));
               },
               "model.own.joints[3].role", "99"},
        Broken{"Mirror", [](v1::ModelSelection* s) { s->mutable_own()->mutable_contacts(0)->set_mirror_contact("x"); },
               "model.own.contacts[0].mirror_contact", "no part"},
        Broken{"Sphere",
               [](v1::ModelSelection* s) {
                 s->mutable_own()->mutable_contacts(0)->mutable_surface()->mutable_sphere()->set_radius_m(0.1);
               },
               "model.own.contacts[0].surface", "ellipsoid"},
        Broken{"Direction",
               [](v1::ModelSelection* s) { s->mutable_own()->mutable_contacts(0)->mutable_directions(0)->set_x(0.5); },
               "model.own.contacts[0].directions", "unit vectors"},
        Broken{"Mass", [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->set_mass_kg(-1); },
               "model.own.joints[3].mass_kg", "is -1"},
        Broken{"PitchOfARevolute",
               [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->set_pitch_m_rad(0.01); },
               "model.own.joints[3].pitch_m_rad", "only a screw"},
        Broken{"ScrewWithoutPitch",
               [](v1::ModelSelection* s) { s->mutable_own()->mutable_joints(3)->set_type(v1::Joint::TYPE_SCREW); },
               "model.own.joints[3].pitch_m_rad", "not 0"},
        Broken{"ScrewOutOfThePlane",
               [](v1::ModelSelection* s) {
                 for (v1::Joint& joint : *s->mutable_own()->mutable_joints()) {
                   if (joint.role() != v1::Joint::ROLE_HIP_FLEXION) continue;
                   joint.set_type(v1::Joint::TYPE_SCREW);
                   joint.set_pitch_m_rad(joint.side() == v1::BODY_SIDE_LEFT ? 0.01 : -0.01);
                 }
               },
               "model.own.joints[3].axis", "out of the plane"},
        Broken{"ScrewAsBase",
               [](v1::ModelSelection* s) {
                 s->mutable_own()->mutable_joints(0)->set_type(v1::Joint::TYPE_SCREW);
                 s->mutable_own()->mutable_joints(0)->set_pitch_m_rad(0.01);
               },
               "model.own.joints[0].type", "must be prismatic"}),
    [](const ::testing::TestParamInfo<Broken>& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace rollgait::server
