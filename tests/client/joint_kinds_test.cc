// Types of joints and their numbers: the tables of core/multibody, the messages and the client say the same.
#include "client/joint_kinds.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/formats/mjcf.h"
#include "client/formats/urdf.h"
#include "client/formats/urdf_side.h"
#include "client/report/kinematics.h"
#include "core/models/joint_chain.h"
#include "core/multibody/body_dynamics.h"
#include "server/convert/joint_convert.h"
#include "server/convert/model_convert.h"
#include "tests/support/random_tree.h"

namespace rollgait::client {
namespace {

using google::protobuf::FieldDescriptor;

std::set<std::string> Doubles(const google::protobuf::Descriptor& message) {
  std::set<std::string> names;
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && !field.is_repeated()) names.insert(field.name());
  }
  return names;
}

// Of a tree in which every joint is of the type; written as GetModel tells it.
class ClientJointKindsTest : public ::testing::TestWithParam<JointType> {
 protected:
  ClientJointKindsTest() {
    std::mt19937 random(3);
    std::vector<Joint> joints = testing::RandomTree(random, 4).joints();
    double value = 0.1;
    for (Joint& joint : joints) {
      testing::SetType(GetParam(), &joint);
      for (const JointNumber& number : kJointNumbers) {
        const double before = joint.*number.member;
        if (number.rule == JointNumberRule::kOther || before != 0) continue;
        joint.*number.member = value += 1.0 / 3;
        if (Problem(number, joint) != nullptr) joint.*number.member = before;
      }
    }
    scene_.emplace(Scene{"tree", "", {}, Model::Create(std::move(joints)).value(), {}, 1, {}});
    written_ = server::EncodeModel(*scene_, 9.81);
  }
  std::optional<Scene> scene_;
  v1::Model written_;
};

TEST_P(ClientJointKindsTest, NumbersComeBackToTheBit) {
  for (int i = 0; i < scene_->model.size(); ++i) {
    const Joint& joint = scene_->model.joint(i);
    const JointKind* const kind = server::DecodeJointType(written_.joints(i).type());
    ASSERT_EQ(kind, &KindOf(GetParam()));
    Joint read;
    read.type = kind->type;
    server::DecodeJointNumbers(written_.joints(i), &read);
    for (const JointNumber& number : kJointNumbers) {
      EXPECT_EQ(read.*number.member, joint.*number.member) << number.field;
    }
    EXPECT_EQ(read.Advance(), joint.Advance());
  }
}

TEST_P(ClientJointKindsTest, ScenesSayTheSameNumbers) {
  for (const Joint& joint : scene_->model.joints()) {
    v1::SceneJoint encoded;
    for (const JointNumber& number : kJointNumbers) {
      if (number.scene_field == nullptr) continue;
      const FieldDescriptor* const field = encoded.GetDescriptor()->FindFieldByName(number.scene_field);
      ASSERT_NE(field, nullptr) << number.scene_field;
      encoded.GetReflection()->SetDouble(&encoded, field, joint.*number.member);
    }
    Joint read;
    read.type = joint.type;
    server::DecodeJointNumbers(encoded, &read);
    for (const JointNumber& number : kJointNumbers) {
      if (number.scene_field == nullptr) continue;
      EXPECT_EQ(read.*number.member, joint.*number.member) << number.scene_field;
    }
  }
}

// Rows name the fields of their members.
TEST_P(ClientJointKindsTest, NumbersGoWhereTheirNamesSay) {
  v1::SceneJoint scene;
  scene.set_stiffness(3);
  scene.set_damping(4);
  scene.set_rest(5);
  scene.set_mass_kg(6);
  Joint read;
  read.type = GetParam();
  server::DecodeJointNumbers(scene, &read);
  EXPECT_EQ(read.stiffness, 3);
  EXPECT_EQ(read.damping, 4);
  EXPECT_EQ(read.rest_position, 5);
  EXPECT_EQ(read.mass, 6);
  v1::Joint encoded;
  server::EncodeJointNumbers(read, &encoded);
  EXPECT_EQ(encoded.stiffness(), 3);
  EXPECT_EQ(encoded.damping(), 4);
  EXPECT_EQ(encoded.rest_position(), 5);
  EXPECT_EQ(encoded.mass_kg(), 6);
}

// The client draws where the judge's dynamics has the links.
TEST_P(ClientJointKindsTest, LinksAreDrawnWhereTheDynamicsHasThem) {
  std::mt19937 random(8);
  const VectorX q = testing::RandomVector(random, 4, 2);
  const std::vector<Pose> poses = LinkPoses(written_, {q.begin(), q.end()});
  BodyDynamics::State state;
  BodyDynamics(scene_->model).ComputeState(q, VectorX::Zero(4), &state);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT((poses[i].position - state[i].p_WL).norm(), 1e-13) << i;
    EXPECT_LT((poses[i].rotation - state[i].R_WL).norm(), 1e-13) << i;
  }
}

TEST_P(ClientJointKindsTest, OptionsAreTheRowOfTheTable) {
  const JointKind& kind = KindOf(GetParam());
  const v1::Joint& joint = written_.joints(0);
  EXPECT_EQ(JointWord(joint), kind.word);
  EXPECT_EQ(Turns(joint), kind.turns);
  EXPECT_EQ(IsSlide(joint), kind.is_slide());
  EXPECT_EQ(Advance(joint), scene_->model.joint(0).Advance());
  const bool both = kind.turns && Advance(joint) != 0;
  EXPECT_EQ(JointText(joint), both ? std::string(kind.word) + " 230 mm/rad" : kind.word);
}

// A format of joints that turn or slide takes these, and says the type and the joint of any other.
TEST_P(ClientJointKindsTest, FormatsTakeItOrSayWhyNot) {
  const JointKind& kind = KindOf(GetParam());
  for (int i = 0; i < 4; ++i) written_.mutable_joints(i)->set_link_name("link" + std::to_string(i));
  const auto said = [](const auto& write) -> std::string {
    try {
      write();
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  };
  const bool taken = !kind.turns || scene_->model.joint(0).Advance() == 0;
  for (const std::string& text :
       {said([&] { ToUrdf(written_); }), said([&] { RequireTurnOrSlide(written_.joints(0), 0); }),
        said([&] { ToMjcf(written_, Ground()); })}) {
    EXPECT_EQ(text.empty(), taken) << text;
    if (taken) continue;
    EXPECT_NE(text.find("model.joints[0].type must be TYPE_REVOLUTE or TYPE_PRISMATIC"), std::string::npos) << text;
    EXPECT_NE(text.find(std::string("joint joint0 is ") + kind.word), std::string::npos) << text;
  }
}

std::string WordOf(const ::testing::TestParamInfo<JointType>& info) { return KindOf(info.param).word; }
INSTANTIATE_TEST_SUITE_P(Types, ClientJointKindsTest, ::testing::ValuesIn(testing::OneDegreeTypes()), WordOf);

TEST(ClientJointKinds, EveryTypeOfTheWireHasARow) {
  const google::protobuf::EnumDescriptor& types = *v1::Joint::Type_descriptor();
  EXPECT_EQ(static_cast<size_t>(types.value_count()), std::size(kJointKinds) + std::size(kChainKinds) + 1);
  for (int i = 1; i < types.value_count(); ++i) {
    const auto type = static_cast<v1::Joint::Type>(types.value(i)->number());
    if (FindChainKind(types.value(i)->name()) != nullptr) {
      EXPECT_EQ(server::DecodeJointType(type), nullptr) << "the tree has its turns";
      EXPECT_NE(types.value(i)->options().GetExtension(v1::joint_word), "");
      continue;
    }
    const JointKind* const kind = server::DecodeJointType(type);
    ASSERT_NE(kind, nullptr) << types.value(i)->name();
    EXPECT_EQ(server::EncodeJointType(kind->type), type);
    v1::Joint joint;
    joint.set_type(type);
    EXPECT_EQ(JointWord(joint), kind->word);
  }
  EXPECT_EQ(server::DecodeJointType(v1::Joint::TYPE_UNSPECIFIED), nullptr);
}

// Every field of a coordinate arrives.
TEST(ClientJointKinds, TurnsOfABallAreItsCoordinates) {
  v1::Joint ball;
  ball.set_type(v1::Joint::TYPE_BALL);
  for (int k = 0; k < 3; ++k) {
    v1::JointCoordinate& coordinate = *ball.add_coordinates();
    const auto& reflection = *coordinate.GetReflection();
    for (int i = 0; i < v1::JointCoordinate::descriptor()->field_count(); ++i) {
      const FieldDescriptor* const field = v1::JointCoordinate::descriptor()->field(i);
      if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) reflection.SetDouble(&coordinate, field, i + 0.1 * k);
      if (field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM) reflection.SetEnumValue(&coordinate, field, k + 1);
    }
    coordinate.set_name("turn");
    coordinate.mutable_axis()->set_y(k);
    coordinate.set_actuated(true);
  }
  const std::vector<v1::Joint> turns = TurnsOf(ball);
  ASSERT_EQ(turns.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(turns[static_cast<size_t>(k)].type(), v1::Joint::TYPE_REVOLUTE);
    // The same fields have the same text, whatever their numbers.
    v1::Joint rest = turns[static_cast<size_t>(k)];
    rest.clear_type();
    std::set<std::string> lines, expected;
    for (const auto& [text, into] :
         {std::pair(rest.DebugString(), &lines), {ball.coordinates(k).DebugString(), &expected}}) {
      for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        into->insert(text.substr(at, text.find('\n', at) - at));
    }
    EXPECT_EQ(lines, expected);
  }
  ball.clear_coordinates();
  EXPECT_EQ(TurnsOf(ball).size(), 1u);
}

TEST(ClientJointKinds, AnUnknownTypeIsSaidByItsNumber) {
  v1::Joint joint;
  joint.set_type(static_cast<v1::Joint::Type>(99));
  EXPECT_EQ(JointWord(joint), "type 99");
  EXPECT_THROW(RequireTurnOrSlide(joint, 0), Failure);
}

// No number of the messages is left out of the table.
TEST(ClientJointKinds, EveryNumberOfTheWireHasARow) {
  std::set<std::string> joint = {"mirror_sign"}, scene = {"effort"};  // which are converted by hand
  for (const JointNumber& number : kJointNumbers) {
    joint.insert(number.field);
    if (number.scene_field != nullptr) scene.insert(number.scene_field);
  }
  EXPECT_EQ(Doubles(*v1::Joint::descriptor()), joint);
  EXPECT_EQ(Doubles(*v1::SceneJoint::descriptor()), scene);
}

}  // namespace
}  // namespace rollgait::client
