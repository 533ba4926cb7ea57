#include "core/multibody/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rollgait {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A trunk on a massless slide, and two legs that mirror each other.
std::vector<Joint> ValidJoints() {
  std::vector<Joint> joints(4);
  const char* names[] = {"slide", "trunk", "left", "right"};
  const int parents[] = {-1, 0, 1, 1};
  for (int i = 0; i < 4; ++i) {
    joints[i].name = names[i];
    joints[i].parent = parents[i];
    if (i == 0) continue;
    joints[i].mass = i;
    joints[i].inertia = Vector3(0.2, 0.3, 0.4).asDiagonal();
  }
  joints[0].type = JointType::kPrismatic;
  for (int i = 2; i < 4; ++i) {
    joints[i].actuated = true;
    joints[i].effort_min = -10;
    joints[i].effort_max = 20;
    joints[i].mirror_joint = 5 - i;
    joints[i].mirror_sign = -1;
  }
  return joints;
}

TEST(ModelTest, KeepsTheTreeAndItsFacts) {
  const Result<Model> result = Model::Create(ValidJoints());
  ASSERT_TRUE(result.ok());
  const Model& model = result.value();
  EXPECT_EQ(model.size(), 4);
  EXPECT_THAT(model.actuated(), ElementsAre(2, 3));
  EXPECT_EQ(model.total_mass(), 6);
  EXPECT_EQ(model.Find("left"), 2);
  EXPECT_EQ(model.Find("tail"), -1);
  EXPECT_EQ(model.parent(3), 1);
  EXPECT_EQ(model.joint(0).mirror_joint, 0);
  EXPECT_EQ(model.joint(2).mirror_joint, 3);
}

TEST(ModelTest, AncestorsAreThePathToTheWorld) {
  const Result<Model> result = Model::Create(ValidJoints());
  ASSERT_TRUE(result.ok());
  const Model& model = result.value();
  EXPECT_TRUE(model.IsAncestor(2, 2));
  EXPECT_TRUE(model.IsAncestor(0, 3));
  EXPECT_FALSE(model.IsAncestor(3, 0));
  EXPECT_FALSE(model.IsAncestor(2, 3));
  EXPECT_TRUE(model.Related(3, 0));
  EXPECT_FALSE(model.Related(2, 3));
}

TEST(ModelTest, AcceptsMassPointsLaminasAndRods) {
  for (const Vector3& moments : {Vector3(0, 0, 0), Vector3(0.1, 0.2, 0.3), Vector3(0, 0.1, 0.1)}) {
    std::vector<Joint> joints = ValidJoints();
    joints[2].inertia = moments.asDiagonal();
    EXPECT_TRUE(Model::Create(joints).ok()) << moments.transpose();
  }
}

struct Refusal {
  const char* name;
  std::function<void(std::vector<Joint>*)> break_it;
  const char* field;
  const char* message;
};

class ModelRefusalTest : public ::testing::TestWithParam<Refusal> {};

TEST_P(ModelRefusalTest, NamesFieldAndReason) {
  std::vector<Joint> joints = ValidJoints();
  GetParam().break_it(&joints);
  const Result<Model> result = Model::Create(std::move(joints));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.violations().front().field, GetParam().field);
  EXPECT_THAT(result.violations().front().message, HasSubstr(GetParam().message));
}

using Joints = std::vector<Joint>*;
INSTANTIATE_TEST_SUITE_P(
    All, ModelRefusalTest,
    ::testing::Values(
        Refusal{"Nothing", [](Joints j) { j->clear(); }, "joints", "empty"},
        Refusal{"EmptyName", [](Joints j) { (*j)[1].name = ""; }, "joints[1].name", "empty"},
        Refusal{"RepeatedName", [](Joints j) { (*j)[3].name = "left"; }, "joints[3].name", "joints[2]"},
        Refusal{"ParentAfterJoint", [](Joints j) { (*j)[2].parent = 3; }, "joints[2].parent", "is 3"},
        Refusal{"ParentIsItself", [](Joints j) { (*j)[2].parent = 2; }, "joints[2].parent", "is 2"},
        Refusal{"ParentBelowWorld", [](Joints j) { (*j)[2].parent = -2; }, "joints[2].parent", "is -2"},
        Refusal{"OriginNotFinite", [](Joints j) { (*j)[1].p_PJ.x() = kNan; }, "joints[1].p_PJ", "finite"},
        Refusal{"Reflection", [](Joints j) { (*j)[1].R_PJ = -Matrix3::Identity(); }, "joints[1].R_PJ", "rotation"},
        Refusal{"RotationNan", [](Joints j) { (*j)[1].R_PJ(0, 0) = kNan; }, "joints[1].R_PJ", "rotation"},
        Refusal{"AxisTooLong", [](Joints j) { (*j)[1].axis *= 1.001; }, "joints[1].axis", "length 1"},
        Refusal{"AxisNan", [](Joints j) { (*j)[1].axis.x() = kNan; }, "joints[1].axis", "finite"},
        Refusal{"PositionRange", [](Joints j) { (*j)[2].position_min = 1, (*j)[2].position_max = 0.5; },
                "joints[2].position_min", "is 1"},
        Refusal{"PositionNan", [](Joints j) { (*j)[2].position_max = kNan; }, "joints[2].position_min", "NaN"},
        Refusal{"VelocityZero", [](Joints j) { (*j)[2].velocity_max = 0; }, "joints[2].velocity_max", "larger than 0"},
        Refusal{"EffortRange", [](Joints j) { (*j)[2].effort_min = 30; }, "joints[2].effort_min", "is 30"},
        Refusal{"EffortWithoutActuator", [](Joints j) { (*j)[1].effort_max = 1; }, "joints[1].effort_max",
                "not actuated"},
        Refusal{"MassNegative", [](Joints j) { (*j)[1].mass = -1; }, "joints[1].mass", "is -1"},
        Refusal{"MassInfinite", [](Joints j) { (*j)[1].mass = kInfinity; }, "joints[1].mass", "finite"},
        Refusal{"LeafWithoutMass", [](Joints j) { (*j)[3].mass = 0, (*j)[3].inertia.setZero(); }, "joints[3].mass",
                "last link"},
        Refusal{"CenterNan", [](Joints j) { (*j)[1].center_of_mass.z() = kNan; }, "joints[1].center_of_mass", "finite"},
        Refusal{"InertiaNan", [](Joints j) { (*j)[1].inertia(0, 1) = kNan; }, "joints[1].inertia", "finite"},
        Refusal{"InertiaAsymmetric", [](Joints j) { (*j)[1].inertia(0, 1) = 0.01; }, "joints[1].inertia", "symmetric"},
        Refusal{"InertiaNegative", [](Joints j) { (*j)[1].inertia(0, 0) = -0.2; }, "joints[1].inertia", "rigid body"},
        Refusal{"InertiaTriangle", [](Joints j) { (*j)[1].inertia(2, 2) = 0.6; }, "joints[1].inertia", "rigid body"},
        Refusal{"InertiaWithoutMass", [](Joints j) { (*j)[0].inertia.setIdentity(); }, "joints[0].inertia",
                "must be 0"},
        Refusal{"MirrorOutOfRange", [](Joints j) { (*j)[1].mirror_joint = 4; }, "joints[1].mirror_joint", "is 4"},
        Refusal{"MirrorOneWay", [](Joints j) { (*j)[1].mirror_joint = 3; }, "joints[1].mirror_joint", "mirrored back"},
        Refusal{"MirrorTypes", [](Joints j) { (*j)[2].type = JointType::kPrismatic; }, "joints[2].mirror_joint",
                "type"},
        Refusal{"MirrorSigns", [](Joints j) { (*j)[2].mirror_sign = 1; }, "joints[2].mirror_sign", "same"},
        Refusal{"RoleTwice",
                [](Joints j) {
                  (*j)[2].role = (*j)[3].role = JointRole::kKneeFlexion;
                  (*j)[2].side = (*j)[3].side = BodySide::kLeft;
                },
                "joints[3].role", "joint \"left\""},
        Refusal{"MirrorSignSize", [](Joints j) { (*j)[1].mirror_sign = 0.5; }, "joints[1].mirror_sign", "1 or -1"}),
    [](const ::testing::TestParamInfo<Refusal>& refusal) { return std::string(refusal.param.name); });

TEST(ModelTest, FindsJointsByRoleAndSide) {
  std::vector<Joint> joints = ValidJoints();
  joints[2].role = joints[3].role = JointRole::kKneeFlexion;
  joints[2].side = BodySide::kLeft;
  joints[3].side = BodySide::kRight;
  const Model model = Model::Create(joints).value();
  EXPECT_EQ(model.Find(JointRole::kKneeFlexion, BodySide::kLeft), 2);
  EXPECT_EQ(model.Find(JointRole::kKneeFlexion, BodySide::kRight), 3);
  EXPECT_EQ(model.Find(JointRole::kKneeFlexion), -1);
  EXPECT_EQ(model.Find(JointRole::kHipFlexion, BodySide::kLeft), -1);
}

// A knee flexes about +y, a hip about -y, as the axis lies in the world and not in the joint's own frame.
TEST(ModelTest, SenseOfFlexionFollowsTheAxisInTheWorld) {
  std::vector<Joint> joints(2);
  for (int i = 0; i < 2; ++i) {
    joints[i].name = joints[i].link = std::string(1, static_cast<char>('a' + i));
    joints[i].parent = i - 1;
    joints[i].mass = 1;
    joints[i].axis = Vector3::UnitY();
    joints[i].side = BodySide::kLeft;
  }
  joints[0].role = JointRole::kHipFlexion;
  joints[1].role = JointRole::kKneeFlexion;
  const Model straight = Model::Create(joints).value();
  EXPECT_EQ(straight.FlexionSign(0), -1);
  EXPECT_EQ(straight.FlexionSign(1), 1);
  joints[0].R_PJ = Vector3(1, -1, -1).asDiagonal();  // half a turn about x
  const Model turned = Model::Create(joints).value();
  EXPECT_EQ(turned.FlexionSign(0), 1);
  EXPECT_EQ(turned.FlexionSign(1), -1);
}

TEST(ModelTest, ReportsEverythingThatIsWrong) {
  std::vector<Joint> joints = ValidJoints();
  joints[0].axis.setZero();
  joints[2].mass = -1;
  const Result<Model> result = Model::Create(std::move(joints));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.violations().size(), 2u);
}

}  // namespace
}  // namespace rollgait
