// MJCF files that must be refused, each with file, element and reason, and what is read of good ones.
#include "client/import/mjcf_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "client/import/side_proposal.h"
#include "client/import/tree_model.h"
#include "client/text.h"
#include "tests/client/import/broken_file.h"

namespace rollgait::client {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr char kGoodMjcf[] = R"(<mujoco model="m">
<compiler angle="degree"/>
<default><geom density="500"/><default class="leg"><joint damping="2" range="-90 30" limited="true"/></default></default>
<worldbody>
<body name="a" pos="0 0 1"><freejoint name="root"/><geom name="g" type="sphere" size="0.1"/>
<body name="b" childclass="leg"><joint name="j" axis="0 1 0" pos="0 0 0.1"/><geom name="c" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/></body>
</body>
</worldbody>
<actuator><motor name="m" joint="j" gear="50" ctrlrange="-1 2" ctrllimited="true"/></actuator>
</mujoco>)";

std::string WithMjcf(const std::string& from, const std::string& to) { return Replaced(kGoodMjcf, from, to); }

std::vector<BrokenFile> BrokenMjcfFiles() {
  std::string deep, many, classes, classes_end, classes_beside;
  for (int i = 0; i < 201; ++i) classes_beside += "<default class=\"d" + std::to_string(i) + "\"/>";
  for (int i = 0; i < 20; ++i) classes += "<default class=\"c" + std::to_string(i) + "\">";
  for (int i = 0; i < 20; ++i) classes_end += "</default>";
  for (int i = 0; i < 200; ++i) deep += "<body>";
  for (int i = 0; i < 1001; ++i) many += "<body><joint/></body>";
  const std::string geom = "type=\"sphere\" size=\"0.1\"", joint = "axis=\"0 1 0\"";
  return {
      {"Empty", "", "is no XML"},
      {"OtherRoot", "<sdf/>", "the root element is <sdf>, must be <robot> (URDF), <mujoco> (MJCF), <OpenSimDocument>"},
      {"EntityBomb", "<!DOCTYPE m [<!ENTITY a \"aaaa\">]>" + std::string(kGoodMjcf), "document type"},
      {"Deep", WithMjcf("<geom name=\"g\"", deep + "<geom name=\"g\""), "nested deeper than 64"},
      {"ManyBodies", WithMjcf("<body name=\"a\"", many + "<body name=\"a\""), "is one of more than 1000"},
      {"ManyJoints", WithMjcf("<geom name=\"g\"", "<geom/>" + std::string(200000, '<')), "at most 100000 are accepted"},
      {"Include", WithMjcf("<worldbody>", "<include file=\"/dev/zero\"/><worldbody>"),
       "x.xml:4: <include>: is content of another file"},
      {"IncludeInBody", WithMjcf("<geom name=\"g\"", "<include file=\"x.xml\"/><geom name=\"g\""),
       "is content of another file, or made by MuJoCo"},
      {"Replicate", WithMjcf("<geom name=\"g\"", "<replicate count=\"1000000000\"/><geom name=\"g\""), "<replicate>"},
      {"MeshMass", WithMjcf(geom, "type=\"mesh\" mesh=\"x\""), "is a mesh, and its mass counts, but no file is opened"},
      {"NoBody", "<mujoco><worldbody/></mujoco>", "has no <body>"},
      {"SameBodyTwice", WithMjcf("name=\"b\"", "name=\"a\""), "<body name=\"a\">: the name is used twice"},
      {"SameJointTwice", Replaced(WithMjcf("name=\"j\"", "name=\"root\""), "joint=\"j\"", "joint=\"root\""),
       "<joint name=\"root\">: the name is used twice"},
      {"JointCalledLikeATurn",
       Replaced(Replaced(WithMjcf("<body name=\"b\"",
                                  "<body name=\"d\"><joint type=\"ball\" name=\"s\"/>"
                                  "<geom name=\"e\" size=\"0.1\"/></body><body name=\"b\""),
                         "name=\"j\"", "name=\"s_x\""),
                "joint=\"j\"", "joint=\"s_x\""),
       "<joint name=\"s_x\">: the name is used twice, and so is called one of the three turns of the joint \"s\""},
      {"LongName", WithMjcf("name=\"b\"", "name=\"" + std::string(300, 'b') + "\""), "name has 300 bytes"},
      {"ControlCharacter", WithMjcf("name=\"b\"", "name=\"b&#x1b;\""), "name holds a control character"},
      {"UnknownClass", WithMjcf("childclass=\"leg\"", "childclass=\"arm\""),
       "is of the class \"arm\", which <default>"},
      {"SameClassTwice",
       WithMjcf("<worldbody>",
                "<default><default class=\"leg\"><default class=\"leg\"/></default></default><worldbody>"),
       "the class \"leg\" stands twice"},
      {"SameDefaultTwice", WithMjcf("<geom density=\"500\"/>", "<geom density=\"500\"/><geom/>"),
       "<geom>: stands twice in its class"},
      {"NestedClasses", WithMjcf("<worldbody>", "<default>" + classes + classes_end + "</default><worldbody>"),
       "is within more than 16 other classes"},
      {"ManyClasses", WithMjcf("<worldbody>", "<default>" + classes_beside + "</default><worldbody>"),
       "is one of more than 200 classes"},
      {"ClassWithoutName", WithMjcf("class=\"leg\"", ""), "<default>: needs the attribute class"},
      {"UnknownJoint", WithMjcf("joint=\"j\"", "joint=\"k\""),
       "<motor name=\"m\">: drives the joint \"k\", which the file"},
      {"NotANumber", WithMjcf(joint, "axis=\"0 nan 0\""), "<joint name=\"j\">: axis has nan; numbers must be finite"},
      {"Huge", WithMjcf("0 0 1\"><free", "0 0 1e12\"><free"), "pos has 1e12"},
      {"Word", WithMjcf("gear=\"50\"", "gear=\"much\""), "gear has \"much\", which is no number"},
      {"TwoNumbers", WithMjcf(joint, "axis=\"0 1\""), "axis has 2 numbers, must have 3"},
      {"NoAxis", WithMjcf(joint, "axis=\"0 0 0\""), "<joint name=\"j\">: its axis has length 0"},
      {"EmptyRange", WithMjcf("range=\"-90 30\"", "range=\"30 30\""), "lower must be below upper"},
      {"NoRange", WithMjcf("range=\"-90 30\"", ""), "is limited, but has no range"},
      {"UnknownType", WithMjcf(joint, "type=\"screw\""),
       "type \"screw\" is unknown; must be free, ball, slide or hinge"},
      {"UnknownGeom", WithMjcf("type=\"sphere\"", "type=\"torus\""),
       "type \"torus\" is unknown; must be plane, sphere"},
      {"NegativeMass", WithMjcf(geom, geom + " mass=\"-1\""), "<geom name=\"g\">: mass is -1 kg"},
      {"NegativeDensity", WithMjcf("density=\"500\"", "density=\"-1\""), "density is -1 kg/m³"},
      {"NegativeSize", WithMjcf("size=\"0.1\"", "size=\"-0.1\""), "<geom name=\"g\">: a size is <= 0"},
      {"NoSize", WithMjcf("size=\"0.1\"", ""), "size has 0 numbers; a sphere needs 1"},
      {"NoLength", WithMjcf("fromto=\"0 0 0 0 0 -0.4\"", "fromto=\"0 0 0 0 0 0\""), "has length 0"},
      {"MassOfAPlanet", WithMjcf(geom, geom + " mass=\"6e8\""), "must be in [0, 1e6] kg"},
      {"Millimetres", WithMjcf("pos=\"0 0 0.1\"", "pos=\"0 0 100\""), "these look like millimetres"},
      {"NegativeInertia",
       WithMjcf("<geom name=\"g\"", "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 -1 1\"/><geom name=\"g\""),
       "has the principal moment -1 kg m²"},
      {"TwoInertias",
       WithMjcf(
           "<geom name=\"g\"",
           "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\" fullinertia=\"1 1 1 0 0 0\"/><geom name=\"g\""),
       "has both diaginertia and fullinertia"},
      {"NoInertialMass", WithMjcf("<geom name=\"g\"", "<inertial pos=\"0 0 0\"/><geom name=\"g\""),
       "<inertial> of <body name=\"a\">: needs the attribute mass"},
      {"TwoOrientations", WithMjcf(geom, geom + " euler=\"0 0 1\" zaxis=\"0 0 1\""), "has several orientations"},
      {"NoQuaternion", WithMjcf(geom, geom + " quat=\"0 0 0 0\""), "quat has length 0"},
      {"GlobalCoordinates", WithMjcf("angle=\"degree\"", "coordinate=\"global\""),
       "coordinate is \"global\"; must be local"},
      {"UnknownAngle", WithMjcf("\"degree\"", "\"gradian\""), "angle is \"gradian\"; must be degree or radian"},
      {"EulerSequence", WithMjcf("angle=\"degree\"", "eulerseq=\"xq\""), "eulerseq is \"xq\""},
      {"FreeInside", WithMjcf("axis=\"0 1 0\"", "type=\"free\""), "is free; the body must be one of the world"},
      {"TwoFree", WithMjcf("<freejoint name=\"root\"/>", "<freejoint/><freejoint/>"), "second free joint"},
      {"NegativeDamping", WithMjcf("damping=\"2\"", "damping=\"-2\""), "its damping is -2"},
      {"ControlRange", WithMjcf("ctrlrange=\"-1 2\"", "ctrlrange=\"2 -1\""), "ctrlrange must have two numbers"},
  };
}

class BrokenMjcfTest : public testing::TestWithParam<BrokenFile> {};
INSTANTIATE_TEST_SUITE_P(Files, BrokenMjcfTest, testing::ValuesIn(BrokenMjcfFiles()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(BrokenMjcfTest, IsRefusedWithFileElementAndReason) { ExpectRefused("x.xml", GetParam()); }

TEST(MjcfTreeTest, ReadsNumbersClassesAndEfforts) {
  const LinkTree tree = ReadLinkTreeText("x.xml", kGoodMjcf);
  ASSERT_EQ(tree.joints.size(), 2u);
  EXPECT_EQ(tree.joints[0].type, TreeJoint::Type::kFloating);
  const TreeJoint& joint = tree.joints[1];
  EXPECT_EQ(joint.name, "j");
  EXPECT_EQ(joint.origin.position, Eigen::Vector3d(0, 0, 0.1)) << "the joint is at its anchor";
  EXPECT_EQ(joint.end.position, Eigen::Vector3d(0, 0, -0.1)) << "the link frame is that of the body";
  EXPECT_NEAR(joint.lower, -kPi / 2, 1e-15);
  EXPECT_NEAR(joint.upper, kPi / 6, 1e-15);
  EXPECT_EQ(joint.damping, 2) << "of the class of the body";
  EXPECT_EQ(joint.effort_min, -50);
  EXPECT_EQ(joint.effort_max, 100);
  const double r = 0.05, h = 0.4;
  EXPECT_NEAR(tree.links[2].mass.mass, 500 * kPi * r * r * (h + 4 * r / 3), 1e-12);
  EXPECT_LT((tree.links[2].mass.center - Eigen::Vector3d(0, 0, -0.2)).norm(), 1e-15);
  ASSERT_EQ(tree.links[2].shapes.size(), 1u);
  EXPECT_THAT(tree.left_out, IsEmpty());
}

TEST(MjcfTreeTest, ReferencesSpringsAndForceRangesCountAsTheFileCounts) {
  const LinkTree tree = ReadLinkTreeText(
      "x.xml",
      Replaced(WithMjcf("axis=\"0 1 0\"", "axis=\"0 1 0\" ref=\"10\" springref=\"-20\" stiffness=\"7\" armature=\"1\""),
               "gear=\"50\"", "gear=\"-50\" forcerange=\"-1 0.5\" forcelimited=\"true\""));
  const TreeJoint& joint = tree.joints[1];
  EXPECT_NEAR(joint.zero, kPi / 18, 1e-15);
  EXPECT_NEAR(joint.rest, -kPi / 9, 1e-15);
  EXPECT_EQ(joint.stiffness, 7);
  EXPECT_EQ(joint.effort_min, -25) << "a negative gear exchanges the ends";
  EXPECT_EQ(joint.effort_max, 50);
  EXPECT_THAT(tree.left_out, testing::ElementsAre(
                                 "x.xml:6: <joint name=\"j\">: armature: links have the inertia of their masses only"));
}

TEST(MjcfTreeTest, RangesOfJointsBoundTheSumOfTheirActuators) {
  const std::string bounded = WithMjcf("axis=\"0 1 0\"", "axis=\"0 1 0\" actuatorfrcrange=\"-60 80\"");
  const std::string two = "<actuator><motor joint=\"j\" gear=\"20\" ctrlrange=\"-1 1\"/>";
  const LinkTree sum = ReadLinkTreeText("x.xml", Replaced(bounded, "<actuator>", two));
  EXPECT_EQ(sum.joints[1].effort_min, -60) << "of 50 and 20";
  EXPECT_EQ(sum.joints[1].effort_max, 80) << "of 100 and 20";
  const LinkTree servo = ReadLinkTreeText(
      "x.xml", Replaced(bounded, "<motor name=\"m\" joint=\"j\" gear=\"50\" ctrlrange=\"-1 2\" ctrllimited=\"true\"/>",
                        "<position joint=\"j\" kp=\"500\" ctrlrange=\"-1 1\"/>"));
  EXPECT_EQ(servo.joints[1].effort_min, -60) << "a servo's control is no force";
  EXPECT_EQ(servo.joints[1].effort_max, 80);
}

TEST(MjcfTreeTest, EverythingThatIsNotReadIsToldWithFileElementAndReason) {
  std::string text =
      WithMjcf("<worldbody>", "<worldbody><light name=\"l\"/><light/><body name=\"box\"><geom size=\"1\"/></body>");
  text = Replaced(text, "<actuator>",
                  "<sensor><gyro/></sensor><tendon/><contact/><equality><weld body1=\"a\" body2=\"b\"/>"
                  "</equality><actuator><muscle joint=\"j\"/>");
  text = Replaced(text, "<geom name=\"c\"",
                  "<joint name=\"k\" type=\"ball\" range=\"0 170\"/><geom mass=\"0\" type=\"mesh\" "
                  "mesh=\"/dev/zero\"/><geom name=\"c\"");
  const LinkTree tree = ReadLinkTreeText("x.xml", text);
  for (const char* const line :
       {"<light name=\"l\"> and 1 more: looks are no part of a model", "<body name=\"box\">: it is fixed to the world",
        "<sensor>: a model has no sensors", "<tendon>: a model has no tendons",
        "<weld>: a model is a tree without constraints", "<muscle>: a model is driven by efforts",
        "<joint name=\"k\">: turns about x of its body beyond ±80°", "no file is opened"}) {
    EXPECT_THAT(tree.left_out, Contains(testing::AllOf(HasSubstr("x.xml:"), HasSubstr(line)))) << line;
  }
  EXPECT_EQ(tree.FindLink("box"), -1);
  EXPECT_TRUE(tree.joints[1].driven) << "the muscle may drive what the file does not say";
}

TEST(MjcfTreeTest, JointsWithoutActuatorAreNotDrivenAndCoupledOnesMimic) {
  const std::string two = WithMjcf("<geom name=\"c\"", "<joint name=\"k\" axis=\"1 0 0\"/><geom name=\"c\"");
  const LinkTree tree = ReadLinkTreeText("x.xml", two);
  EXPECT_TRUE(tree.joints[static_cast<size_t>(tree.FindJoint("j"))].driven);
  EXPECT_FALSE(tree.joints[static_cast<size_t>(tree.FindJoint("k"))].driven);
  EXPECT_EQ(tree.links[static_cast<size_t>(tree.joints[1].child)].name, "j_link");
  const LinkTree coupled = ReadLinkTreeText(
      "x.xml", Replaced(two, "<actuator>", "<equality><joint joint1=\"k\" joint2=\"j\"/></equality><actuator>"));
  EXPECT_EQ(coupled.joints[static_cast<size_t>(coupled.FindJoint("k"))].mimics, "j");
}

TEST(MjcfTreeTest, BallsAreThreeTurns) {
  const std::string ball =
      WithMjcf("<geom name=\"c\"", "<joint name=\"k\" type=\"ball\" pos=\"0 0 0.1\" range=\"0 40\"/><geom name=\"c\"");
  const LinkTree tree = ReadLinkTreeText("x.xml", ball);
  const auto turn = [](const LinkTree& of, const char* name) {
    return of.joints[static_cast<size_t>(of.FindJoint(name))];
  };
  const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()};
  const char* const names[] = {"k_y", "k_x", "k_z"};
  for (int i = 0; i < 3; ++i) {
    const TreeJoint joint = turn(tree, names[i]);
    EXPECT_EQ(joint.type, TreeJoint::Type::kRevolute);
    EXPECT_EQ(joint.axis, axes[i]);
    EXPECT_NEAR(joint.upper, 40 * kPi / 180, 1e-15);
    EXPECT_EQ(joint.lower, -joint.upper);
    EXPECT_FALSE(joint.driven);
    if (i == 0) continue;
    EXPECT_EQ(joint.parent, turn(tree, names[i - 1]).child);
    EXPECT_EQ(joint.origin.position, Eigen::Vector3d::Zero());
  }
  const LinkTree endless = ReadLinkTreeText("x.xml", Replaced(ball, "range=\"0 40\"", "limited=\"false\""));
  EXPECT_EQ(turn(endless, "k_y").type, TreeJoint::Type::kContinuous);
  EXPECT_NEAR(turn(endless, "k_x").upper, 80 * kPi / 180, 1e-15);
  for (const char* const range : {"0 -1", "-40 40"}) {
    EXPECT_THROW(ReadLinkTreeText("x.xml", Replaced(ball, "0 40", range)), Failure) << range;
  }

  // A motor about one of its axes is that of the turn; another must be said.
  const LinkTree driven = ReadLinkTreeText(
      "x.xml", Replaced(ball, "<actuator>", "<actuator><motor joint=\"k\" gear=\"0 0 20\" ctrlrange=\"-1 2\"/>"));
  EXPECT_EQ(turn(driven, "k_z").effort_min, -20);
  EXPECT_EQ(turn(driven, "k_z").effort_max, 40);
  EXPECT_TRUE(turn(driven, "k_z").driven);
  EXPECT_FALSE(turn(driven, "k_x").driven);
  const LinkTree oblique = ReadLinkTreeText(
      "x.xml", Replaced(ball, "<actuator>", "<actuator><motor joint=\"k\" gear=\"0 1 20\" ctrlrange=\"-1 2\"/>"));
  EXPECT_TRUE(turn(oblique, "k_x").driven);
  EXPECT_THAT(oblique.left_out, Contains(HasSubstr("about an oblique axis")));
}

TEST(MjcfTreeTest, ABallAtTheBaseIsAPartOfItOrFixed) {
  const std::string slides =
      "<joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/><joint name=\"y\" type=\"slide\" axis=\"0 1 0\"/>"
      "<joint name=\"z\" type=\"slide\" axis=\"0 0 1\"/>";
  const std::string ball = "<joint name=\"k\" type=\"ball\"/>";
  const LinkTree floats = ReadLinkTreeText("x.xml", WithMjcf("<freejoint name=\"root\"/>", slides + ball));
  EXPECT_EQ(floats.joints[0].type, TreeJoint::Type::kFloating);
  EXPECT_EQ(floats.FindJoint("k_y"), -1);
  const LinkTree fixed = ReadLinkTreeText("x.xml", WithMjcf("<freejoint name=\"root\"/>", ball));
  EXPECT_EQ(fixed.joints[0].type, TreeJoint::Type::kFixed);
  EXPECT_THAT(fixed.left_out, Contains(HasSubstr("<joint name=\"k\">: it holds the base")));
}

TEST(MjcfTreeTest, SlidesAndATurnInThePlaneAreTheBase) {
  const std::string planar =
      WithMjcf("<freejoint name=\"root\"/>",
               "<joint name=\"x\" type=\"slide\" axis=\"1 0 0\"/><joint name=\"z\" type=\"slide\" axis=\"0 0 1\"/>"
               "<joint name=\"pitch\" axis=\"0 1 0\"/>");
  const LinkTree tree = ReadLinkTreeText("x.xml", planar);
  EXPECT_EQ(tree.joints[0].type, TreeJoint::Type::kFloating);
  EXPECT_TRUE(tree.base_in_plane);
  EXPECT_EQ(ProposeSideFile(tree).side.base(), v1::ModelSideFile::BASE_PLANE);
  // Out of the plane it is a chain like others.
  const LinkTree tilted = ReadLinkTreeText("x.xml", Replaced(planar, "axis=\"1 0 0\"", "axis=\"1 0.1 0\""));
  EXPECT_EQ(tilted.joints[0].type, TreeJoint::Type::kPrismatic);
  EXPECT_FALSE(tilted.base_in_plane);
}

TEST(MjcfTreeTest, TheHumanoidIsProposedWhole) {
  const LinkTree tree = ReadLinkTree(ROLLGAIT_SOURCE "/tests/data/humanoid.xml");
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, IsEmpty());
  EXPECT_EQ(proposal.side.contacts_size(), 2);
  const ImportedModel imported = ModelOfTree(tree, "s.json", proposal.side);
  EXPECT_EQ(imported.model.joints_size(), 6 + 15);
  int roles = 0;
  for (const v1::Joint& joint : imported.model.joints()) roles += joint.role() > v1::Joint::ROLE_BASE_PITCH;
  EXPECT_EQ(roles, 11) << "hips, knees, ankles, shoulders, elbows, trunk";
  EXPECT_THAT(imported.assumed, Contains(HasSubstr("20 rad/s")));
  EXPECT_THAT(imported.model.summary().description(), HasSubstr("read from MJCF"));
}

// A trunk that carries the legs by joints of its own: these are of no leg, and bend no trunk above the base.
TEST(MjcfTreeTest, JointsThatCarryBothLegsHaveNeitherRoleNorSide) {
  std::string legs;
  for (const char* const side : {"left", "right"}) {
    const std::string y = std::string(side) == "left" ? "0.1" : "-0.1", name = side;
    legs += "<body name=\"" + name + "_thigh\" pos=\"0 " + y + " 0\"><joint name=\"" + name +
            "_hip\" axis=\"0 1 0\" range=\"-90 30\"/><geom type=\"capsule\" fromto=\"0 0 0 0 0 -0.4\" size=\"0.05\"/>"
            "<body name=\"" +
            name + "_shank\" pos=\"0 0 -0.4\"><joint name=\"" + name +
            "_knee\" axis=\"0 1 0\" range=\"0 120\"/><geom type=\"capsule\" fromto=\"0 0 0 0.1 0 -0.4\" "
            "size=\"0.05\"/></body></body>";
  }
  const LinkTree tree = ReadLinkTreeText(
      "x.xml",
      "<mujoco><worldbody><body name=\"trunk\"><freejoint/><geom size=\"0.2\"/><body name=\"pelvis\" pos=\"0 0 -0.4\">"
      "<joint name=\"abdomen\" axis=\"0 1 0\" range=\"-30 30\"/><geom size=\"0.1\"/>" +
          legs + "</body></body></worldbody></mujoco>");
  const SideProposal proposal = ProposeSideFile(tree);
  ASSERT_EQ(proposal.side.joints_size(), 5);
  int hips = 0;
  for (const v1::SideJoint& joint : proposal.side.joints()) {
    const bool abdomen = joint.name() == "abdomen";
    EXPECT_EQ(joint.role() == v1::Joint::ROLE_UNSPECIFIED, abdomen) << joint.name();
    EXPECT_EQ(joint.side() == v1::BODY_SIDE_UNSPECIFIED, abdomen) << joint.name();
    EXPECT_FALSE(joint.locked()) << joint.name();
    hips += joint.role() == v1::Joint::ROLE_HIP_FLEXION;
  }
  EXPECT_EQ(hips, 2);
}

TEST(MjcfTreeTest, NamesThatAModelCannotHaveAreProposedOtherwise) {
  std::string text = ReadModelBytes(ROLLGAIT_SOURCE "/tests/data/humanoid.xml");
  text = Replaced(text, "model=\"humanoid_of_tests\"", "model=\"Humanoid of \u00e4\"");
  const SideProposal proposal = ProposeSideFile(ReadLinkTreeText("x.xml", text));
  EXPECT_EQ(proposal.side.name(), "Humanoid_of___");
  EXPECT_THAT(proposal.missing, IsEmpty());
  EXPECT_THAT(ProposeSideFile(ReadLinkTree(ROLLGAIT_SOURCE "/tests/data/humanoid.xml")).side.name(), IsEmpty());
}

TEST(MjcfTreeTest, LargeFilesTakeBoundedMemory) {
  std::string body;
  while (body.size() < (size_t{3} << 20)) body += "<geom size=\"0.001\" a=\"\" b=\"\" c=\"\" d=\"\" e=\"\" f=\"\"/>";
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const LinkTree tree = ReadLinkTreeText("x.xml", WithMjcf("<geom name=\"g\"", body + "<geom name=\"g\""));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_GT(tree.links[1].shapes.size(), 50000u);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 150 * 1024) << "kB";
}

}  // namespace
}  // namespace rollgait::client
