// Universal and ball joints: the trees that they stand for, the way back to the bit, and what is refused.
#include "server/convert/joint_chains.h"

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "tests/support/ball_joints.h"

namespace rollgait::server {
namespace {

using rollgait::testing::HumanBalls;
using rollgait::testing::WithBalls;

v1::Model Human() {
  BodyRequest body;
  body.model = "human29";
  v1::Model model = EncodeModel(BuildScene(body).value(), 9.81);
  model.clear_selection();
  model.clear_stature_m();
  return model;
}

v1::Model Balls() { return WithBalls(Human(), HumanBalls()); }

// JSON drops the sign of zeros, which axes have.
std::string Bits(const v1::Model& model) {
  std::string text;
  EXPECT_TRUE(google::protobuf::util::MessageToJsonString(model, &text).ok());
  v1::Model read;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &read).ok());
  return read.SerializeAsString();
}

Result<GaitSpec> Checked(const v1::Model& model) {
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = model;
  return DecodeSpec(spec);
}

int Find(const v1::Model& model, const std::string& name) {
  for (int i = 0; i < model.joints_size(); ++i) {
    if (model.joints(i).name() == name) return i;
  }
  return -1;
}

TEST(JointChains, ComeBackToTheBit) {
  ASSERT_EQ(Balls().joints_size(), 29 - 5 * 2 - 2 * 1);
  const Result<GaitSpec> checked = Checked(Balls());
  ASSERT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
  const v1::Model back = EncodeModel(checked.value().scene, 9.81);
  EXPECT_EQ(Bits(back), Bits(Balls()));
  EXPECT_EQ(back.summary().degrees_of_freedom(), 29);
  EXPECT_TRUE(checked.value().scene.symmetric);
}

// Written as results have it, it is the human of the list in every bit: dynamics and solver see no difference.
TEST(JointChains, AreTheRevoluteJointsThatTheyStandForToTheBit) {
  const Result<GaitSpec> checked = Checked(Balls());
  ASSERT_TRUE(checked.ok());
  EXPECT_EQ(Bits(EncodeModel(checked.value().scene, 9.81, JointForm::kChains)), Bits(Human()));
  Violations violations;
  const UnfoldedModel unfolded = UnfoldJointChains("", Balls(), &violations);
  EXPECT_TRUE(violations.empty());
  EXPECT_EQ(Bits(unfolded.model), Bits(Human()));
  EXPECT_EQ(unfolded.chains.size(), 7u);
}

TEST(JointChains, AModelWithoutThemIsUnfoldedAsItIs) {
  Violations violations;
  EXPECT_EQ(UnfoldJointChains("", Human(), &violations).model.SerializeAsString(), Human().SerializeAsString());
}

TEST(JointChains, CoordinatesWithoutNameAreNumbered) {
  v1::Model model = Balls();
  const int trunk = Find(model, "trunk");
  for (v1::JointCoordinate& coordinate : *model.mutable_joints(trunk)->mutable_coordinates()) coordinate.clear_name();
  const Result<GaitSpec> checked = Checked(model);
  ASSERT_TRUE(checked.ok());
  const v1::Joint back = EncodeModel(checked.value().scene, 9.81).joints(trunk);
  EXPECT_EQ(back.coordinates(0).name(), "trunk_1");
  EXPECT_EQ(back.coordinates(2).name(), "trunk_3");
  EXPECT_EQ(checked.value().scene.model.joint(checked.value().scene.model.Find("trunk_2")).link, "trunk_2_link");
}

// A body whose joints are their own mirror images says no sign.
TEST(JointChains, WithoutMirrorSignsEachIsItsOwnImage) {
  v1::Model model = Balls();
  for (v1::Joint& joint : *model.mutable_joints()) {
    joint.clear_mirror_sign();
    for (v1::JointCoordinate& coordinate : *joint.mutable_coordinates()) coordinate.clear_mirror_sign();
  }
  const Result<GaitSpec> checked = Checked(model);
  ASSERT_TRUE(checked.ok()) << checked.violations()[0].field << " " << checked.violations()[0].message;
  EXPECT_FALSE(checked.value().scene.symmetric);
}

// The table of core/models/joint_chain.h and the message name the same fields.
TEST(JointChains, EveryFieldOfACoordinateIsOneOfAJointAndInTheTable) {
  std::set<std::string> table(std::begin(kCoordinateFields), std::end(kCoordinateFields)), message;
  const google::protobuf::Descriptor& coordinate = *v1::JointCoordinate::descriptor();
  for (int i = 0; i < coordinate.field_count(); ++i) {
    message.insert(coordinate.field(i)->name());
    const auto* const of_joint = v1::Joint::descriptor()->FindFieldByName(coordinate.field(i)->name());
    ASSERT_NE(of_joint, nullptr) << coordinate.field(i)->name();
    EXPECT_EQ(of_joint->cpp_type(), coordinate.field(i)->cpp_type());
  }
  EXPECT_EQ(table, message);
}

// A range that a request sets is held to the same.
TEST(JointChains, LimitsOfARequestStayOutOfTheSingularity) {
  v1::SolveSpec spec;
  *spec.mutable_model()->mutable_own() = Balls();
  v1::Range& range = (*spec.mutable_limits()->mutable_joint_position())["hip_adduction_l"];
  range.set_min(-1.3);
  range.set_max(1.5);
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.violations()[0].field, "limits.joint_position[\"hip_adduction_l\"]");
  EXPECT_NE(checked.violations()[0].message.find("-1.3 to 1.5 rad"), std::string::npos);
}

struct Broken {
  const char* name;
  std::function<void(v1::Model*)> change;
  const char* field;  // "@" stands for the joint's path
  const char* message;
  const char* joint = "hip_ball_l";
};
void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenChainTest : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenChainTest, IsRefusedByPath) {
  v1::Model model = Balls();
  GetParam().change(&model);
  std::string field = GetParam().field;
  if (field[0] == '@') field = "joints[" + std::to_string(Find(Balls(), GetParam().joint)) + "]" + field.substr(1);
  const Result<GaitSpec> checked = Checked(model);
  ASSERT_FALSE(checked.ok());
  std::string said;
  bool found = false;
  for (const Violation& violation : checked.violations()) {
    said += violation.field + " " + violation.message + "\n";
    found = found || (violation.field == "model.own." + field &&
                      violation.message.find(GetParam().message) != std::string::npos);
  }
  EXPECT_TRUE(found) << field << "\n" << said;
}

v1::Joint* Ball(v1::Model* model) { return model->mutable_joints(Find(*model, "hip_ball_l")); }
v1::JointCoordinate* Turn(v1::Model* model, int k) { return Ball(model)->mutable_coordinates(k); }
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Models, BrokenChainTest,
    ::testing::Values(
        Broken{"TooFew", [](v1::Model* m) { Ball(m)->mutable_coordinates()->RemoveLast(); }, "@.coordinates",
               "are 2; must be 3 of TYPE_BALL"},
        Broken{"TooMany", [](v1::Model* m) { Ball(m)->add_coordinates(); }, "@.coordinates", "are 4; must be 3"},
        Broken{"AMillion",
               [](v1::Model* m) {
                 for (int i = 0; i < 1000000; ++i) Ball(m)->add_coordinates();
               },
               "@.coordinates", "are 1000003; must be 3"},
        Broken{"ThreeOfAUniversal", [](v1::Model* m) { Ball(m)->set_type(v1::Joint::TYPE_UNIVERSAL); },
               "@.coordinates", "are 3; must be 2 of TYPE_UNIVERSAL"},
        Broken{"OfARevolute", [](v1::Model* m) { m->mutable_joints(0)->add_coordinates(); }, "joints[0].coordinates",
               "must be none"},
        Broken{"AxisBesideThem", [](v1::Model* m) { Ball(m)->mutable_axis()->set_x(1); }, "@.axis", "must be unset"},
        Broken{"RangeBesideThem", [](v1::Model* m) { Ball(m)->set_position_max(1); }, "@.position_max",
               "must be unset of TYPE_BALL"},
        Broken{"MirrorSignBesideThem", [](v1::Model* m) { Ball(m)->set_mirror_sign(1); }, "@.mirror_sign", "unset"},
        Broken{"Pitch", [](v1::Model* m) { Ball(m)->set_pitch_m_rad(0.1); }, "@.pitch_m_rad", "only a screw"},
        Broken{"NoAxis", [](v1::Model* m) { Turn(m, 1)->clear_axis(); }, "@.coordinates[1].axis", "length 1"},
        Broken{"LongAxis", [](v1::Model* m) { Turn(m, 2)->mutable_axis()->set_z(2); }, "@.coordinates[2].axis",
               "length 1"},
        Broken{"AxisNotANumber", [](v1::Model* m) { Turn(m, 0)->mutable_axis()->set_x(kNan); }, "@.coordinates[0].axis",
               "finite"},
        Broken{"ParallelAxes", [](v1::Model* m) { *Turn(m, 1)->mutable_axis() = Turn(m, 0)->axis(); },
               "@.coordinates[1].axis", "0° from the line of the axis before it; must be at least 10°"},
        Broken{"OppositeAxes",
               [](v1::Model* m) {
                 *Turn(m, 2)->mutable_axis() = Turn(m, 1)->axis();
                 Turn(m, 2)->mutable_axis()->set_x(-Turn(m, 1)->axis().x());
               },
               "@.coordinates[2].axis", "must be at least 10°"},
        Broken{"OverTheSingularity", [](v1::Model* m) { Turn(m, 1)->set_position_max(1.6); },
               "@.coordinates[1].position_min", "must stay within -1.39626 to 1.39626 rad: at -1.5708 and 1.5708 rad"},
        Broken{"NearTheSingularity", [](v1::Model* m) { Turn(m, 1)->set_position_min(-1.4); },
               "@.coordinates[1].position_min", "-1.4 to"},
        Broken{"EndlessMiddle",
               [](v1::Model* m) {
                 Turn(m, 1)->set_position_min(-kInfinity);
                 Turn(m, 1)->set_position_max(kInfinity);
               },
               "@.coordinates[1].position_min", "must stay within"},
        Broken{"RangeNotANumber", [](v1::Model* m) { Turn(m, 2)->set_position_min(kNan); },
               "@.coordinates[2].position_min", "NaN"},
        Broken{"NegativeDamping", [](v1::Model* m) { Turn(m, 2)->set_damping(-1); }, "@.coordinates[2].damping",
               "at least 0"},
        Broken{"Mass", [](v1::Model* m) { Ball(m)->set_mass_kg(-1); }, "@.mass_kg", "at least 0"},
        Broken{"TakenName", [](v1::Model* m) { Ball(m)->set_name("knee_r"); }, "@.name", "another joint"},
        Broken{"NoName", [](v1::Model* m) { Ball(m)->clear_name(); }, "@.name", "letters"},
        Broken{"TakenCoordinate", [](v1::Model* m) { Turn(m, 1)->set_name("base_x"); }, "@.coordinates[1].name",
               "used twice"},
        Broken{"LongCoordinate", [](v1::Model* m) { Turn(m, 1)->set_name(std::string(62, 'a')); },
               "@.coordinates[1].name", "letters"},
        Broken{"Role", [](v1::Model* m) { Turn(m, 1)->set_role(static_cast<v1::Joint::Role>(99)); },
               "@.coordinates[1].role", "99"},
        Broken{"Parent", [](v1::Model* m) { Ball(m)->set_parent(40); }, "@.parent", "is 40; must be -1"},
        Broken{"MirrorOfAnotherType", [](v1::Model* m) { Ball(m)->set_mirror_joint(0); }, "@.mirror_joint",
               "another type"},
        Broken{"MirrorOutOfRange", [](v1::Model* m) { Ball(m)->set_mirror_joint(99); }, "@.mirror_joint", "is 99"},
        Broken{"Contact", [](v1::Model* m) { m->mutable_contacts(0)->set_joint(17); }, "contacts[0].joint",
               "is 17; the model has joints 0 to 16"},
        Broken{"TooManyTogether",
               [](v1::Model* m) {
                 for (int i = 0; i < 13; ++i) {
                   v1::Joint& joint = *m->add_joints() = *Ball(m);
                   joint.set_name("more" + std::to_string(i));
                 }
               },
               "joints", "are 68 with coordinates; at most 64"},
        // After it, what is wrong is named by the message's own indices.
        Broken{"MassBehindThem", [](v1::Model* m) { m->mutable_joints(16)->set_mass_kg(-1); }, "joints[16].mass_kg",
               "of joint \"elbow_r\""}),
    [](const ::testing::TestParamInfo<Broken>& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace rollgait::server
