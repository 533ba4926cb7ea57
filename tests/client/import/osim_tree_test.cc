// OpenSim models that must be refused, each with file, element and reason, and what is read of a good one.
#include "client/import/osim_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_model.h"
#include "client/import/tree_posture.h"
#include "tests/client/import/broken_file.h"

namespace rollgait::client {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kWalker[] = ROLLGAIT_SOURCE "/tests/data/walker.osim";

constexpr char kGoodOsim[] = R"(<OpenSimDocument Version="40000">
<Model name="m">
<gravity>0 -9.80665 0</gravity>
<Ground name="ground"/>
<BodySet><objects>
<Body name="pelvis"><mass>10</mass><mass_center>0.1 0.2 0.3</mass_center><inertia>1 2 2.5 0.1 0.2 0.3</inertia></Body>
<Body name="femur"><mass>5</mass><mass_center>0 -0.2 0</mass_center><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet><objects>
<FreeJoint name="ground_pelvis"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/pelvis</socket_child_frame>
<coordinates><Coordinate name="rx"/><Coordinate name="ry"/><Coordinate name="rz"/><Coordinate name="tx"/><Coordinate name="ty"/><Coordinate name="tz"/></coordinates></FreeJoint>
<PinJoint name="hip"><socket_parent_frame>pelvis_offset</socket_parent_frame><socket_child_frame>femur_offset</socket_child_frame>
<coordinates><Coordinate name="hip_flexion"><default_value>0.1</default_value><range>-0.5 1.5</range><locked>false</locked></Coordinate></coordinates>
<frames><PhysicalOffsetFrame name="pelvis_offset"><socket_parent>/bodyset/pelvis</socket_parent><translation>0.1 0.2 0.3</translation><orientation>0 0 0.4</orientation></PhysicalOffsetFrame>
<PhysicalOffsetFrame name="femur_offset"><socket_parent>/bodyset/femur</socket_parent><translation>0 0.05 0</translation></PhysicalOffsetFrame></frames></PinJoint>
</objects></JointSet>
<ForceSet><objects>
<CoordinateActuator name="a"><coordinate>hip_flexion</coordinate><optimal_force>100</optimal_force><min_control>-1</min_control><max_control>2</max_control></CoordinateActuator>
</objects></ForceSet>
</Model>
</OpenSimDocument>)";

std::string WithOsim(const std::string& from, const std::string& to) { return Replaced(kGoodOsim, from, to); }

std::vector<BrokenFile> BrokenOsimFiles() {
  std::string many, deep;
  for (int i = 0; i < 1001; ++i) many += "<Body name=\"b" + std::to_string(i) + "\"/>";
  for (int i = 0; i < 200; ++i) deep += "<x>";
  const std::string pin = "<PinJoint name=\"hip\">", pin_end = "</PinJoint>";
  const std::string loop =
      "<PinJoint name=\"loop\"><socket_parent_frame>femur</socket_parent_frame><socket_child_frame>pelvis"
      "</socket_child_frame><coordinates><Coordinate name=\"l\"/></coordinates></PinJoint>";
  return {
      {"Truncated", std::string(kGoodOsim).substr(0, 900), "is no XML"},
      {"EntityBomb", "<!DOCTYPE m [<!ENTITY a \"aaaa\">]>" + std::string(kGoodOsim), "document type"},
      {"Deep", WithOsim("<Ground name=\"ground\"/>", deep), "nested deeper than 64"},
      {"ManyBodies", WithOsim("<Body name=\"pelvis\">", many + "<Body name=\"pelvis\">"), "is one of more than 1000"},
      {"Version3", WithOsim("40000", "30000"),
       "<OpenSimDocument>: is of version 30000; from 40000 on are read: open it in"},
      {"NoVersion", WithOsim(" Version=\"40000\"", ""), "needs the attribute Version"},
      {"NoModel", "<OpenSimDocument Version=\"40000\"/>", "needs an element <Model>"},
      {"NoBodies", "<OpenSimDocument Version=\"40000\"><Model name=\"m\"/></OpenSimDocument>", "has no <Body>"},
      {"ZIsUp", WithOsim("0 -9.80665 0", "0 0 -9.80665"), "its gravity is (0, 0, -9.807); Y must be up"},
      {"SameBodyTwice", WithOsim("<Body name=\"femur\">", "<Body name=\"pelvis\"/><Body name=\"femur\">"),
       "<Body name=\"pelvis\">: the name is used twice"},
      {"SameCoordinateTwice",
       WithOsim("</objects></JointSet>", Replaced(loop, "\"l\"", "\"hip_flexion\"") + "</objects></JointSet>"),
       "<Coordinate name=\"hip_flexion\">: the name is used twice"},
      {"Loop", WithOsim("</objects></JointSet>", loop + "</objects></JointSet>"),
       "has a parent already; closed chains are not read"},
      {"NoParent", WithOsim("/bodyset/femur</socket_parent>", "/bodyset/tibia</socket_parent>"),
       "the frame \"/bodyset/tibia\" is neither the ground nor a body of the file"},
      {"NoSocket", WithOsim("<socket_child_frame>femur_offset</socket_child_frame>", ""),
       "<PinJoint name=\"hip\">: needs the path of a frame"},
      {"FramesInThemselves", WithOsim("/bodyset/femur</socket_parent>", "femur_offset</socket_parent>"),
       "is in more than 8 others, or in itself"},
      {"GroundAsChild", WithOsim("<socket_child_frame>femur_offset", "<socket_child_frame>/ground"),
       "its child is the ground"},
      {"UnconnectedBody", WithOsim("<Body name=\"femur\">", "<Body name=\"lost\"/><Body name=\"femur\">"),
       "<Body name=\"lost\">: is the child of no joint"},
      {"UnknownJoint",
       Replaced(WithOsim(pin, "<ScapulothoracicJoint name=\"hip\">"), pin_end, "</ScapulothoracicJoint>"),
       "<ScapulothoracicJoint name=\"hip\">: is of a kind that is not read; must be WeldJoint, PinJoint"},
      {"TooFewCoordinates", Replaced(WithOsim(pin, "<GimbalJoint name=\"hip\">"), pin_end, "</GimbalJoint>"),
       "has 1 coordinates, must have 3"},
      {"NotANumber", WithOsim("<mass>10</mass>", "<mass>nan</mass>"),
       "<Body name=\"pelvis\">: <mass> has nan; numbers must be finite"},
      {"NegativeMass", WithOsim("<mass>10</mass>", "<mass>-10</mass>"), "<Body name=\"pelvis\">: its mass is -10 kg"},
      {"InertiaWithoutMass", WithOsim("<mass>10</mass>", "<mass>0</mass>"), "its mass is 0, but its inertia is not"},
      {"NegativeInertia", WithOsim("1 2 2.5 0.1", "-1 2 2.5 0.1"), "none may be negative"},
      {"FiveMoments", WithOsim("1 2 2.5 0.1 0.2 0.3", "1 2 2.5 0.1 0.2"), "<inertia> has 5 numbers, must have 6"},
      {"MassTwice", WithOsim("<mass>10</mass>", "<mass>10</mass><mass>1</mass>"),
       "<mass> of <Body name=\"pelvis\">: stands twice"},
      {"Millimetres", WithOsim("<translation>0.1 0.2 0.3", "<translation>100 200 300"), "these look like millimetres"},
      {"EmptyRange", WithOsim("-0.5 1.5", "1.5 -0.5"), "<Coordinate name=\"hip_flexion\">: its range has lower 1.5"},
      {"NoFlag", WithOsim("<locked>false", "<locked>perhaps"), "<locked> is \"perhaps\"; must be true or false"},
      {"Controls", WithOsim("<max_control>2", "<max_control>-2"), "min_control must be below max_control"},
  };
}

class BrokenOsimTest : public testing::TestWithParam<BrokenFile> {};
INSTANTIATE_TEST_SUITE_P(Files, BrokenOsimTest, testing::ValuesIn(BrokenOsimFiles()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(BrokenOsimTest, IsRefusedWithFileElementAndReason) { ExpectRefused("x.osim", GetParam()); }

TEST(OsimTreeTest, ReadsFramesInTheServicesAxes) {
  const LinkTree tree = ReadLinkTreeText("x.osim", kGoodOsim);
  ASSERT_EQ(tree.joints.size(), 2u);
  EXPECT_EQ(tree.joints[0].type, TreeJoint::Type::kFloating);
  const TreeJoint& hip = tree.joints[1];
  EXPECT_EQ(hip.name, "hip_flexion");
  EXPECT_EQ(hip.origin.position, Eigen::Vector3d(0.1, -0.3, 0.2)) << "X, Y, Z are x, z, -y";
  EXPECT_LT((hip.origin.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(std::cos(0.4), 0, std::sin(0.4))).norm(),
            1e-15);
  EXPECT_EQ(hip.axis, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(hip.end.position, Eigen::Vector3d(0, 0, -0.05));
  EXPECT_EQ(hip.lower, -0.5);
  EXPECT_EQ(hip.effort_min, -100);
  EXPECT_EQ(hip.effort_max, 200);
  const MassProperties& pelvis = tree.links[1].mass;
  EXPECT_EQ(pelvis.center, Eigen::Vector3d(0.1, -0.3, 0.2));
  Eigen::Matrix3d inertia;
  inertia << 1, -0.2, 0.1, -0.2, 2.5, -0.3, 0.1, -0.3, 2;
  EXPECT_EQ(pelvis.inertia, inertia);
}

// Simbody's Gimbal, Universal and Planar: turns about X, Y, Z as the turns before have left them, slides before turns.
TEST(OsimTreeTest, EveryKindOfJointIsTheSequenceOfItsCoordinates) {
  const Eigen::Vector3d x(1, 0, 0), y(0, 0, 1), z(0, -1, 0);  // OpenSim's, in the service's axes
  struct Kind {
    const char* name;
    int coordinates;
    std::vector<std::pair<std::string, Eigen::Vector3d>> steps;  // coordinate, axis
  };
  const Kind kKinds[] = {{"WeldJoint", 0, {}},
                         {"PinJoint", 1, {{"q0", z}}},
                         {"SliderJoint", 1, {{"q0", x}}},
                         {"UniversalJoint", 2, {{"q0", x}, {"q1", y}}},
                         {"GimbalJoint", 3, {{"q0", x}, {"q1", y}, {"q2", z}}},
                         {"BallJoint", 3, {{"q0", x}, {"q1", y}, {"q2", z}}},
                         {"PlanarJoint", 3, {{"q1", x}, {"q2", y}, {"q0", z}}},
                         {"FreeJoint", 6, {{"q3", x}, {"q4", y}, {"q5", z}, {"q0", x}, {"q1", y}, {"q2", z}}}};
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(kind.name);
    std::string text = kGoodOsim, coordinates;
    for (int i = 0; i < kind.coordinates; ++i) coordinates += "<Coordinate name=\"q" + std::to_string(i) + "\"/>";
    const std::string name = kind.name;
    const size_t from = text.find("<PinJoint"), to = text.find("</PinJoint>") + 11, forces = text.find("<ForceSet>");
    text.erase(forces, text.find("</ForceSet>") + 11 - forces);
    text.replace(from, to - from,
                 "<" + name +
                     " name=\"k\"><socket_parent_frame>pelvis</socket_parent_frame><socket_child_frame>femur"
                     "</socket_child_frame><coordinates>" +
                     coordinates + "</coordinates></" + name + ">");
    const LinkTree tree = ReadLinkTreeText("x.osim", text);
    if (kind.steps.empty()) {
      EXPECT_EQ(tree.joints[1].type, TreeJoint::Type::kFixed);
      continue;
    }
    ASSERT_EQ(tree.joints.size(), 1 + kind.steps.size());
    for (size_t i = 0; i < kind.steps.size(); ++i) {
      const TreeJoint& joint = tree.joints[1 + i];
      EXPECT_EQ(joint.name, kind.steps[i].first);
      EXPECT_EQ(joint.axis, kind.steps[i].second);
      const bool slides = name == "SliderJoint" || (name == "PlanarJoint" && i < 2) || (name == "FreeJoint" && i < 3);
      EXPECT_EQ(joint.type, slides ? TreeJoint::Type::kPrismatic : TreeJoint::Type::kContinuous);
      EXPECT_EQ(tree.links[static_cast<size_t>(joint.child)].name,
                i + 1 == kind.steps.size() ? "femur" : joint.name + "_link");
    }
  }
}

TEST(OsimTreeTest, ActuatorsWithoutLimitsAreDrivenByPlusMinusOne) {
  const LinkTree tree = ReadLinkTreeText(
      "x.osim", Replaced(WithOsim("<min_control>-1", "<min_control>-Inf"), "<max_control>2", "<max_control>inf"));
  EXPECT_EQ(tree.joints[1].effort_min, -100);
  EXPECT_EQ(tree.joints[1].effort_max, 100);
  EXPECT_THAT(tree.assumed, Contains(HasSubstr("±1")));
}

// gait10dof18musc's structure: a planar pelvis, and a knee whose shank slides as it bends.
TEST(OsimTreeTest, TheWalkerIsReadWithWhatIsLeftOutTold) {
  const LinkTree tree = ReadLinkTree(kWalker);
  EXPECT_TRUE(tree.base_in_plane);
  for (const char* const line :
       {"<TransformAxis name=\"translation1\"> and 3 more: it moves by a function of a coordinate",
        "<Coordinate name=\"subtalar_angle_r\"> and 1 more: it is locked in the file",
        "<Thelen2003Muscle name=\"soleus_r\"> and 1 more: a model has efforts, springs and dampers of joints only",
        "<CoordinateActuator name=\"pelvis_ty_residual\">: it acts on the base",
        "<ContactSphere name=\"heel_r\"> and 3 more: the ground is met", "<Marker name=\"sacrum\">"}) {
    EXPECT_THAT(tree.left_out, Contains(HasSubstr(line))) << line;
  }
  // Where the shank is with a straight leg: of the splines of walker.osim at 0.
  const int knee = tree.FindJoint("knee_angle_r");
  const TreePosture posture = PostureOf(tree, kNoMotion, {}, std::vector<bool>(tree.joints.size(), false));
  const Eigen::Vector3d to_knee =
      posture.joints[static_cast<size_t>(knee)] - posture.links[static_cast<size_t>(tree.FindLink("femur_r"))].position;
  EXPECT_NEAR(to_knee.x(), -0.0031 - (0.005227 - 0.0031) * 0.174533 / (0.174533 + 0.197344), 1e-12);
  EXPECT_NEAR(to_knee.z(), -0.3966 + (0.3966 - 0.395264) * 0.174533 / (0.174533 + 0.159149), 1e-12);
  double mass = 0;
  for (const TreeLink& link : tree.links) mass += link.mass.mass;
  EXPECT_NEAR(mass, 75.1646, 1e-9);

  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, IsEmpty());
  EXPECT_EQ(proposal.side.base(), v1::ModelSideFile::BASE_PLANE);
  ASSERT_EQ(proposal.side.contacts_size(), 2) << "of the spheres of heel and toes";
  CheckSideFile("s.json", proposal.side, tree);
  const v1::Model model = ModelOfTree(tree, "s.json", proposal.side).model;
  EXPECT_EQ(model.joints_size(), 3 + 7);
  int roles = 0;
  for (const v1::Joint& joint : model.joints()) roles += joint.role() > v1::Joint::ROLE_BASE_PITCH;
  EXPECT_EQ(roles, 7) << "hips, knees, ankles, trunk";
}

TEST(OsimTreeTest, LinesWithOffsetsAndSignsAreJoints) {
  const std::string custom = R"(<CustomJoint name="hip"><socket_parent_frame>pelvis</socket_parent_frame>
<socket_child_frame>femur</socket_child_frame><coordinates><Coordinate name="hip_flexion"/><Coordinate name="hip_slide"/></coordinates>
<SpatialTransform><TransformAxis name="rotation1"><coordinates>hip_flexion</coordinates><axis>0 0 1</axis>
<LinearFunction><coefficients>-1 0.2</coefficients></LinearFunction></TransformAxis>
<TransformAxis name="rotation2"><coordinates/><axis>0 1 0</axis><function><Constant><value>0.3</value></Constant></function></TransformAxis>
<TransformAxis name="translation2"><coordinates>hip_slide</coordinates><axis>0 1 0</axis>
<MultiplierFunction><function><LinearFunction><coefficients>2 0.1</coefficients></LinearFunction></function><scale>0.5</scale></MultiplierFunction>
</TransformAxis></SpatialTransform></CustomJoint>)";
  std::string text = kGoodOsim;
  const size_t from = text.find("<PinJoint"), to = text.find("</PinJoint>") + 11;
  const LinkTree tree = ReadLinkTreeText("x.osim", text.replace(from, to - from, custom));
  ASSERT_EQ(tree.joints.size(), 3u);
  const TreeJoint &slide = tree.joints[1], &hip = tree.joints[2];
  EXPECT_EQ(slide.name, "hip_slide") << "slides come before turns";
  EXPECT_NEAR(slide.zero, -0.05, 1e-15);
  EXPECT_EQ(slide.axis, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(hip.axis, Eigen::Vector3d(0, 1, 0));
  EXPECT_NEAR(hip.zero, 0.2, 1e-15) << "-q + 0.2 is no turn at q = 0.2";
  EXPECT_LT((hip.end.rotation - Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix()).norm(), 1e-15);
}

}  // namespace
}  // namespace rollgait::client
