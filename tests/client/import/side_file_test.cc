// Side files that must be refused, each with file, field and reason.
#include "client/import/side_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "client/failure.h"
#include "client/import/model_file.h"
#include "client/import/tree_file.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

LinkTree TwoLegs() {
  return ReadLinkTreeText(
      "x.urdf",
      "<robot name=\"r\"><link name=\"body\"/><link name=\"left\"/><link name=\"right\"/>"
      "<joint name=\"hip_l\" type=\"continuous\"><parent link=\"body\"/><child link=\"left\"/></joint>"
      "<joint name=\"hip_r\" type=\"continuous\"><parent link=\"body\"/><child link=\"right\"/></joint></robot>");
}

v1::ModelSideFile GoodSide() {
  v1::ModelSideFile side;
  side.add_joints()->set_name("hip_l");
  side.add_joints()->set_name("base_yaw");
  for (const char* name : {"left", "right"}) {
    v1::SideContact& contact = *side.add_contacts();
    contact.set_name(name);
    contact.set_link(name);
    contact.set_side(std::string(name) == "left" ? v1::BODY_SIDE_LEFT : v1::BODY_SIDE_RIGHT);
    v1::Vector3& axes = *contact.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
    axes.set_x(0.1);
    axes.set_y(0.1);
    axes.set_z(0.1);
  }
  return side;
}

TEST(BrokenSideFileTest, IsRefusedByFieldAndValue) {
  const LinkTree tree = TwoLegs();
  EXPECT_NO_THROW(CheckSideFile("s.json", GoodSide(), tree));
  const struct {
    void (*damage)(v1::ModelSideFile&);
    const char* says;
  } kCases[] = {
      {[](v1::ModelSideFile& s) { s.set_name("my robot"); }, "name must be 1 to 64 letters"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts()->RemoveLast(); }, "contacts are 1; 2 to 16 are accepted"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_name("hip_ll"); },
       "joints[0].name \"hip_ll\" is no joint of x.urdf; did you mean hip_l?"},
      {[](v1::ModelSideFile& s) { *s.add_joints() = s.joints(0); }, "joints[2].name \"hip_l\" stands twice"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_reference(std::nan("")); }, "joints[0].reference is nan"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_position_max(std::numeric_limits<double>::infinity()); },
       "joints[0].positionMax is inf; must be finite"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_velocity_max(0); },
       "velocityMax of \"hip_l\" is 0; must be > 0"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_stiffness(-1); },
       "joints[0].stiffness of \"hip_l\" is -1; must be at least 0"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_damping(std::nan("")); },
       "joints[0].damping of \"hip_l\" is nan; must be at least 0"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_rest_position(std::nan("")); },
       "joints[0].restPosition is nan; must be finite"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(1)->set_damping(1); },
       "joints[1].stiffness or damping of \"base_yaw\" cannot be given: the base floats"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_mirror_sign(2); },
       "mirrorSign of \"hip_l\" is 2; must be 1, -1 or 0"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_role(static_cast<v1::Joint::Role>(99)); },
       "is no value of this enum"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(1)->set_locked(true); }, "cannot be given: the base floats"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(1)->set_role(v1::Joint::ROLE_BASE_YAW); }, "is known; leave it out"},
      {[](v1::ModelSideFile& s) { s.set_base(v1::ModelSideFile::BASE_PLANE); }, "\"base_yaw\" is no joint of x.urdf"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts(1)->set_link("rihgt"); },
       "contacts[1].link of \"right\" is \"rihgt\", no link of x.urdf; did you mean right?"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts(1)->set_name("left"); }, "contacts[1].name \"left\" stands twice"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts(0)->clear_side(); }, "contacts[0].side must be BODY_SIDE_LEFT"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts(0)->clear_surface(); }, "must be an ellipsoid, a superellipsoid"},
      {[](v1::ModelSideFile& s) {
         s.mutable_contacts(0)->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->set_x(120);
       },
       "must be an ellipsoid, a superellipsoid"},
      {[](v1::ModelSideFile& s) { s.mutable_contacts(0)->mutable_center_m()->set_x(432); },
       "every component must be within ±10 m"},
      {[](v1::ModelSideFile& s) { s.mutable_base_orientation()->set_w(2); },
       "baseOrientation is a quaternion of length 2"},
      {[](v1::ModelSideFile& s) {
         s.mutable_joints(0)->set_role(v1::Joint::ROLE_BASE_PITCH);
         s.mutable_base_orientation()->set_w(1);
       },
       "baseOrientation must not be given where joints of the file have base roles"},
      {[](v1::ModelSideFile& s) {
         s.mutable_joints(0)->set_role(v1::Joint::ROLE_BASE_PITCH);
         s.mutable_base_position_m()->set_z(0.9);
       },
       "basePositionM must not be given where joints of the file have base roles"},
      {[](v1::ModelSideFile& s) { s.mutable_joints(0)->set_name("hip\x1b[2J\n\x7f"); },
       "joints[0].name \"hip?[2J??\" is no joint of x.urdf"},
      {[](v1::ModelSideFile& s) { s.set_leg_length_m(900); }, "legLengthM is 900 m; must be in [0.05, 3] m"},
  };
  for (const auto& [damage, says] : kCases) {
    v1::ModelSideFile side = GoodSide();
    damage(side);
    try {
      CheckSideFile("s.json", side, tree);
      FAIL() << "accepted: " << says;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_THAT(failure.what(), StartsWith("s.json: "));
      EXPECT_THAT(failure.what(), HasSubstr(says));
      std::printf("%s\n", failure.what());
    }
  }
}

TEST(SideFileTest, AUrdfNeedsOneAndNothingElseTakesOne) {
  EXPECT_TRUE(IsModelFile("a.urdf"));
  EXPECT_FALSE(IsModelFile("planar"));
  const auto refusal = [](const std::string& path, const std::string& side) -> std::string {
    try {
      ReadModelFile(path, side);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "read";
  };
  EXPECT_THAT(refusal("robot.urdf", ""), HasSubstr("rollgait models robot.urdf --propose-side"));
  EXPECT_THAT(refusal("robot.json", "s.json"),
              HasSubstr("--side: belongs to a model in a .urdf, .xml, .mjcf or .osim file"));
  const std::string path = testing::TempDir() + "two_legs.urdf", side = testing::TempDir() + "two_legs.json";
  std::ofstream(path) << "<robot name=\"r\"><link name=\"a\"/></robot>";
  std::ofstream(side) << "{\"feet\": 2}";
  EXPECT_THAT(refusal(path, side), HasSubstr("not a proto3 JSON rollgait.v1.ModelSideFile"));
}

}  // namespace
}  // namespace rollgait::client
