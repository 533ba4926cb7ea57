// What is proposed for a URDF: from the example, from one that is turned, damaged or named otherwise.
#include "client/import/side_proposal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "client/import/foot_fit.h"
#include "client/import/limb_roles.h"
#include "client/import/mirror_average.h"
#include "client/import/mirror_images.h"
#include "client/import/mirror_names.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"

namespace rollgait::client {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kBiped[] = ROLLGAIT_SOURCE "/examples/biped/biped.urdf";

std::string BipedWith(const std::string& from, const std::string& to) {
  std::string text = ReadModelBytes(kBiped);
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

v1::Joint::Role RoleOf(const v1::ModelSideFile& side, const std::string& joint) {
  for (const v1::SideJoint& from : side.joints()) {
    if (from.name() == joint) return from.role();
  }
  ADD_FAILURE() << joint;
  return v1::Joint::ROLE_UNSPECIFIED;
}

TEST(MirrorNamesTest, KnowsHowRobotsAreNamed) {
  const struct {
    const char *name, *other;
    v1::BodySide side;
  } kCases[] = {
      {"left_hip", "right_hip", v1::BODY_SIDE_LEFT},   {"hip_right", "hip_left", v1::BODY_SIDE_RIGHT},
      {"LeftKnee", "RightKnee", v1::BODY_SIDE_LEFT},   {"L_ANKLE", "R_ANKLE", v1::BODY_SIDE_LEFT},
      {"knee_r", "knee_l", v1::BODY_SIDE_RIGHT},       {"leg.l.2", "leg.r.2", v1::BODY_SIDE_LEFT},
      {"LHipPitch", "RHipPitch", v1::BODY_SIDE_LEFT},  {"rElbow", "lElbow", v1::BODY_SIDE_RIGHT},
      {"KneeR", "KneeL", v1::BODY_SIDE_RIGHT},         {"torso", "torso", v1::BODY_SIDE_UNSPECIFIED},
      {"lumbar", "lumbar", v1::BODY_SIDE_UNSPECIFIED}, {"ROLL", "ROLL", v1::BODY_SIDE_UNSPECIFIED},
  };
  for (const auto& [name, other, side] : kCases) {
    EXPECT_EQ(MirrorNameOf(name).other, other) << name;
    EXPECT_EQ(MirrorNameOf(name).side, side) << name;
    EXPECT_EQ(MirrorNameOf(MirrorNameOf(name).other).other, name);
  }
}

TEST(LimbRolesTest, NamesComeBeforeOrder) {
  const auto leg = [](int index, const std::string& name, double across) {
    return LimbJoint{index, name, v1::BODY_SIDE_LEFT, true, across};
  };
  const auto roles = [](const std::vector<LimbJoint>& joints) {
    std::map<int, v1::Joint::Role> found;
    for (const LimbRole& role : ProposeRoles(joints)) EXPECT_TRUE(found.emplace(role.index, role.role).second);
    return found;
  };
  using Found = std::map<int, v1::Joint::Role>;
  const Found three = {
      {1, v1::Joint::ROLE_HIP_FLEXION}, {2, v1::Joint::ROLE_KNEE_FLEXION}, {3, v1::Joint::ROLE_ANKLE_DORSIFLEXION}};
  EXPECT_EQ(roles({leg(0, "hip_roll", 0), leg(1, "Hip_Pitch", 1), leg(2, "KNEE", 1), leg(3, "ankle", 0.8)}), three);
  EXPECT_EQ(roles({leg(1, "j1", 1), leg(2, "j2", 1), leg(3, "j3", 1)}), three);
  EXPECT_EQ(roles({leg(1, "j1", 1), leg(2, "knee", 1), leg(3, "j3", 1)}), three);
  // A joint before the knee stays the hip where another lies between.
  EXPECT_EQ(roles({leg(1, "j1", 1), leg(9, "j9", 1), leg(2, "knee", 1), leg(3, "j3", 1)}), three);
  EXPECT_EQ(roles({leg(0, "hip", 0.4)}), Found{}) << "turns sideways";
  EXPECT_EQ(roles({{4, "waist_pitch", v1::BODY_SIDE_UNSPECIFIED, false, 1},
                   {5, "torso_pitch", v1::BODY_SIDE_UNSPECIFIED, false, 1}}),
            (Found{{4, v1::Joint::ROLE_TRUNK_FLEXION}}));
  EXPECT_EQ(roles({{6, "r_elbow", v1::BODY_SIDE_RIGHT, false, 1}}), (Found{{6, v1::Joint::ROLE_ELBOW_FLEXION}}));
}

TEST(FootFitTest, TouchesTheBottomOfTheShapes) {
  const LinkTree tree = ReadLinkTreeText(
      "x.urdf",
      "<robot name=\"r\"><link name=\"a\"><collision><origin xyz=\"0.05 0 0\" rpy=\"0 1.5707963267948966 0\"/>"
      "<geometry><cylinder radius=\"0.03\" length=\"0.2\"/></geometry></collision>"
      "<collision><origin xyz=\"0 0.02 -0.01\"/><geometry><sphere radius=\"0.04\"/></geometry></collision>"
      "<collision><origin xyz=\"0 0 0\" rpy=\"0 0 0.7853981633974483\"/><geometry>"
      "<box size=\"0.04 0.04 0.02\"/></geometry></collision></link></robot>");
  const TreePosture posture = PostureOf(tree, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 1)}, {}, {});
  const std::optional<Extent> extent = ExtentOf(tree, posture, {0});
  ASSERT_TRUE(extent.has_value());
  EXPECT_LT((extent->least - Eigen::Vector3d(-0.05, -0.03, 0.95)).norm(), 1e-12) << extent->least.transpose();
  EXPECT_LT((extent->most - Eigen::Vector3d(0.15, 0.06, 1.03)).norm(), 1e-12) << extent->most.transpose();
  const FittedEllipsoid foot = FitFoot(*extent, 0.5);
  EXPECT_NEAR(foot.semi_axes.x(), 0.1, 1e-12);
  EXPECT_NEAR(foot.semi_axes.y(), 0.045, 1e-12);
  EXPECT_NEAR(foot.semi_axes.x() * foot.semi_axes.x() / foot.semi_axes.z(), 0.15, 1e-5) << "sole radius";
  EXPECT_NEAR(foot.center.z() - foot.semi_axes.z(), 0.95, 1e-12);
  EXPECT_FALSE(ExtentOf(tree, posture, {}).has_value());
}

TEST(SideProposalTest, TheExampleGetsRolesFeetAndMirrorImages) {
  const LinkTree tree = ReadLinkTree(kBiped);
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, IsEmpty());
  EXPECT_EQ(proposal.side.mirror(), v1::ModelSideFile::MIRROR_UNSPECIFIED);
  EXPECT_FALSE(proposal.side.has_base_orientation());
  for (const char* side : {"left", "right"}) {
    const std::string name = side;
    EXPECT_EQ(RoleOf(proposal.side, name + "_hip_pitch"), v1::Joint::ROLE_HIP_FLEXION);
    EXPECT_EQ(RoleOf(proposal.side, name + "_knee"), v1::Joint::ROLE_KNEE_FLEXION);
    EXPECT_EQ(RoleOf(proposal.side, name + "_ankle_pitch"), v1::Joint::ROLE_ANKLE_DORSIFLEXION);
    EXPECT_EQ(RoleOf(proposal.side, name + "_hip_roll"), v1::Joint::ROLE_UNSPECIFIED);
  }
  ASSERT_EQ(proposal.side.contacts_size(), 2);
  EXPECT_NO_THROW(CheckSideFile("s.json", proposal.side, tree));
  const v1::Model model = ModelOfTree(tree, "s.json", proposal.side).model;
  EXPECT_EQ(MirrorDifference(model), "");
  for (const v1::Joint& joint : model.joints()) {
    EXPECT_EQ(model.joints(joint.mirror_joint()).name(), MirrorNameOf(joint.name()).other);
    const bool sideways = joint.name().find("roll") != std::string::npos ||
                          joint.name().find("yaw") != std::string::npos || joint.name() == "base_y";
    EXPECT_EQ(joint.mirror_sign(), sideways ? -1 : 1) << joint.name();
  }
  EXPECT_EQ(model.contacts(0).mirror_contact(), "right_foot");
}

TEST(SideProposalTest, ARobotThatFacesElsewhereIsTurned) {
  // The same robot whose pelvis is turned by 90° within its root link: it faces y.
  const std::string turned =
      BipedWith("<robot name=\"biped\">",
                "<robot name=\"biped\"><link name=\"root\"/><joint name=\"turn\" type=\"fixed\"><parent link=\"root\"/>"
                "<child link=\"pelvis\"/><origin xyz=\"0 0 0\" rpy=\"0 0 1.5707963267948966\"/></joint>");
  const LinkTree tree = ReadLinkTreeText("x.urdf", turned);
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.reasons, Contains(HasSubstr("the root is turned by -90° about z")));
  const v1::Model model = ModelOfTree(tree, "s.json", proposal.side).model;
  const v1::Model straight =
      ModelOfTree(ReadLinkTree(kBiped), "s.json", ProposeSideFile(ReadLinkTree(kBiped)).side).model;
  const std::vector<double> zeros(static_cast<size_t>(model.joints_size()), 0.0);
  const std::vector<Pose> found = LinkPoses(model, zeros), expected = LinkPoses(straight, zeros);
  for (size_t i = 6; i < found.size(); ++i) EXPECT_LT((found[i].position - expected[i].position).norm(), 1e-12) << i;
}

// Links of the models of two descriptions of one robot are in the same places.
void ExpectSamePlaces(const std::string& urdf) {
  const auto model_of = [](const LinkTree& tree) {
    return ModelOfTree(tree, "s.json", ProposeSideFile(tree).side).model;
  };
  const v1::Model model = model_of(ReadLinkTreeText("x.urdf", urdf)), straight = model_of(ReadLinkTree(kBiped));
  const std::vector<double> zeros(static_cast<size_t>(model.joints_size()), 0.0);
  const std::vector<Pose> found = LinkPoses(model, zeros), expected = LinkPoses(straight, zeros);
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 6; i < found.size(); ++i) EXPECT_LT((found[i].position - expected[i].position).norm(), 1e-12) << i;
}

// The robot within a root link whose axes point elsewhere.
std::string BipedTurned(const std::string& rpy) {
  return BipedWith("<robot name=\"biped\">",
                   "<robot name=\"biped\"><link name=\"root\"/><joint name=\"turn\" type=\"fixed\"><parent "
                   "link=\"root\"/><child link=\"pelvis\"/><origin xyz=\"0 0 0\" rpy=\"" +
                       rpy + "\"/></joint>");
}

TEST(SideProposalTest, WhateverAxisIsUpTheRobotStands) {
  for (const char* const rpy : {"-1.5707963267948966 0 0", "1.5707963267948966 0 0", "0 1.5707963267948966 0",
                                "3.141592653589793 0 0", "-1.5707963267948966 0 -1.5707963267948966"}) {
    SCOPED_TRACE(rpy);
    const SideProposal proposal = ProposeSideFile(ReadLinkTreeText("x.urdf", BipedTurned(rpy)));
    EXPECT_THAT(proposal.reasons, Contains(HasSubstr("the legs hang then along −z")));
    ExpectSamePlaces(BipedTurned(rpy));
  }
}

TEST(SideProposalTest, NamesWithoutSidesAreMirroredByPlaces) {
  const std::string left = BipedWith("left_", "one");
  std::string text = left;
  for (size_t at = text.find("right_"); at != std::string::npos; at = text.find("right_", at))
    text.replace(at, 6, "two");
  const LinkTree tree = ReadLinkTreeText("x.urdf", text);
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, IsEmpty());
  EXPECT_EQ(proposal.side.mirror(), v1::ModelSideFile::MIRROR_UNSPECIFIED);
  const v1::Model model = ModelOfTree(tree, "s.json", proposal.side).model;
  int pairs = 0;
  for (const v1::Joint& joint : model.joints()) {
    if (joint.name().rfind("one", 0) != 0) continue;
    EXPECT_EQ(model.joints(joint.mirror_joint()).name(), "two" + joint.name().substr(3));
    ++pairs;
  }
  EXPECT_EQ(pairs, 6);
}

TEST(SideProposalTest, ARobotWithoutSidewaysJointsWalksInThePlane) {
  std::string text = ReadModelBytes(kBiped);
  for (const char* const axis : {"xyz=\"1 0 0\"", "xyz=\"0 0 1\""}) {
    for (size_t at = text.find(axis); at != std::string::npos; at = text.find(axis, at))
      text.replace(at, 11, "xyz=\"0 1 0\"");
  }
  const SideProposal proposal = ProposeSideFile(ReadLinkTreeText("x.urdf", text));
  EXPECT_EQ(proposal.side.base(), v1::ModelSideFile::BASE_PLANE);
  EXPECT_THAT(proposal.reasons, Contains(HasSubstr("no joint moves out of the plane")));
  EXPECT_EQ(proposal.side.bodies_size(), 0) << "legs pass each other";
  EXPECT_EQ(ProposeSideFile(ReadLinkTree(kBiped)).side.base(), v1::ModelSideFile::BASE_UNSPECIFIED);
}

// Hips and feet in one place: the knees tell where the left is.
TEST(SideProposalTest, ARobotDrawnInAPlaneFacesWhereItsKneesDoNotBend) {
  const auto planar = [](const std::string& axis, const std::string& range) {
    std::string text = "<robot name=\"r\"><link name=\"body\"/>";
    for (const std::string side : {"left", "right"}) {
      const std::string mass =
          "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" "
          "ixz=\"0\" iyz=\"0\"/></inertial>";
      text += "<link name=\"" + side + "_thigh\">" + mass + "</link><link name=\"" + side + "_shank\">" + mass +
              "<collision><origin xyz=\"0 0 -0.4\"/><geometry><sphere radius=\"0.02\"/></geometry></collision></link>"
              "<joint name=\"" +
              side + "_hip\" type=\"revolute\"><parent link=\"body\"/><child link=\"" + side +
              "_thigh\"/><axis xyz=\"" + axis +
              "\"/><limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"9\"/>"
              "</joint><joint name=\"" +
              side + "_knee\" type=\"revolute\"><parent link=\"" + side + "_thigh\"/><child link=\"" + side +
              "_shank\"/><origin xyz=\"0 0 -0.4\"/><axis xyz=\"" + axis + "\"/><limit " + range +
              " effort=\"9\" velocity=\"9\"/></joint>";
    }
    return ReadLinkTreeText("x.urdf", text + "</robot>");
  };
  const std::string bends = "lower=\"0\" upper=\"2\"", bends_back = "lower=\"-2\" upper=\"0\"";
  EXPECT_FALSE(ProposeSideFile(planar("0 1 0", bends)).side.has_base_orientation());
  EXPECT_THAT(ProposeSideFile(planar("1 0 0", bends)).reasons, Contains(HasSubstr("turned by 90° about z")));
  EXPECT_THAT(ProposeSideFile(planar("1 0 0", bends_back)).reasons, Contains(HasSubstr("turned by -90° about z")));
  EXPECT_THAT(ProposeSideFile(planar("0 1 0", bends_back)).reasons, Contains(HasSubstr("turned by 180° about z")));
}

// Each foot a link with toes behind a joint of their own.
std::string BipedWithToes(double height) {
  std::string text = ReadModelBytes(kBiped), toes;
  for (const std::string side : {"left", "right"}) {
    toes += "<link name=\"" + side +
            "_toes\"><inertial><mass value=\"0.2\"/><inertia ixx=\"1e-3\" iyy=\"1e-3\" "
            "izz=\"1e-3\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><collision><origin xyz=\"0.03 0 " +
            std::to_string(height) +
            "\"/><geometry><box size=\"0.06 0.1 0.06\"/></geometry></collision></link>"
            "<joint name=\"" +
            side + "_toe\" type=\"revolute\"><parent link=\"" + side + "_foot\"/><child link=\"" + side +
            "_toes\"/><origin xyz=\"0.15 0 -0.04\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" "
            "effort=\"10\" velocity=\"9\"/></joint>";
  }
  return text.insert(text.rfind("</robot>"), toes);
}

TEST(SideProposalTest, FeetWithToesStandOnBothParts) {
  const LinkTree tree = ReadLinkTreeText("x.urdf", BipedWithToes(0));
  const SideProposal proposal = ProposeSideFile(tree);
  EXPECT_THAT(proposal.missing, IsEmpty());
  ASSERT_EQ(proposal.side.contacts_size(), 4);
  EXPECT_EQ(proposal.side.contacts(0).name(), "left_heel");
  EXPECT_EQ(proposal.side.contacts(0).link(), "left_foot");
  EXPECT_EQ(proposal.side.contacts(0).part(), v1::ContactSurface::FOOT_PART_HEEL);
  EXPECT_EQ(proposal.side.contacts(1).name(), "left_toes");
  EXPECT_EQ(proposal.side.contacts(1).link(), "left_toes");
  EXPECT_EQ(proposal.side.contacts(1).part(), v1::ContactSurface::FOOT_PART_TOE);
  EXPECT_EQ(proposal.side.body_pairs_size(), 4);
  const v1::Model model = ModelOfTree(tree, "s.json", proposal.side).model;
  EXPECT_EQ(model.contacts(1).mirror_contact(), "right_toes");

  const SideProposal raised = ProposeSideFile(ReadLinkTreeText("x.urdf", BipedWithToes(0.05)));
  ASSERT_EQ(raised.side.contacts_size(), 2) << "toes above the ground";
  EXPECT_EQ(raised.side.contacts(0).link(), "left_foot");
  EXPECT_EQ(raised.side.contacts(0).part(), v1::ContactSurface::FOOT_PART_WHOLE);
}

TEST(SideProposalTest, SaysWhatDiffersAndWhatIsMissing) {
  const std::string heavy = "<mass value=\"2.6\"/>";
  std::string text = ReadModelBytes(kBiped);
  text.replace(text.find(heavy), heavy.size(), "<mass value=\"2.7\"/>");
  const LinkTree uneven_tree = ReadLinkTreeText("x.urdf", text);
  const SideProposal uneven = ProposeSideFile(uneven_tree);
  EXPECT_EQ(uneven.side.mirror(), v1::ModelSideFile::MIRROR_AVERAGED);
  EXPECT_THAT(uneven.reasons, Contains(HasSubstr("masses of \"left_shank\" and \"right_shank\", 2.7 and 2.6 kg")));
  const ImportedModel averaged = ModelOfTree(uneven_tree, "s.json", uneven.side);
  EXPECT_EQ(MirrorDifference(averaged.model), "");
  EXPECT_THAT(averaged.model.sources(), Contains(HasSubstr("left and right averaged: masses by up to 1.9 %")));
  for (const v1::Joint& joint : averaged.model.joints()) {
    if (joint.link_name().find("shank") != std::string::npos) {
      EXPECT_NEAR(joint.mass_kg(), 2.65, 1e-12);
    }
  }
  text = ReadModelBytes(kBiped);
  text.replace(text.find(heavy), heavy.size(), "<mass value=\"5\"/>");
  const SideProposal lame = ProposeSideFile(ReadLinkTreeText("x.urdf", text));
  EXPECT_EQ(lame.side.mirror(), v1::ModelSideFile::MIRROR_NONE);
  EXPECT_THAT(lame.reasons, Contains(HasSubstr("walks in full cycles")));

  const SideProposal meshes = ProposeSideFile(
      ReadLinkTreeText("x.urdf", BipedWith("<box size=\"0.22 0.1 0.06\"/>", "<mesh filename=\"foot.stl\"/>")));
  EXPECT_EQ(meshes.side.contacts_size(), 0);
  EXPECT_THAT(meshes.missing,
              Contains(HasSubstr(
                  "contact \"left_foot\": link \"left_foot\" has no box, sphere, cylinder, capsule or ellipsoid")));
  const SideProposal weak = ProposeSideFile(ReadLinkTreeText("x.urdf", BipedWith("effort=\"120\"", "effort=\"0\"")));
  EXPECT_THAT(weak.missing, Contains(HasSubstr("joint \"left_ankle_pitch\" has no limit of effort or velocity")));
  const SideProposal bent = ProposeSideFile(
      ReadLinkTreeText("x.urdf", BipedWith("lower=\"0\" upper=\"2.2\"", "lower=\"0.1\" upper=\"2.2\"")));
  EXPECT_THAT(bent.reasons, Contains(HasSubstr("reference of joint \"left_knee\"")));
  EXPECT_THAT(bent.missing, IsEmpty());
}

// Whatever two sides are given, what is averaged is symmetric, weighs the same, and is unchanged by averaging again.
TEST(MirrorAverageTest, MakesLeftAndRightMirrorImages) {
  const LinkTree tree = ReadLinkTree(kBiped);
  v1::Model model = ModelOfTree(tree, "s.json", ProposeSideFile(tree).side).model;
  double mass = 0, averaged_mass = 0;
  double shift = 0.001;
  for (v1::Joint& joint : *model.mutable_joints()) {
    if (joint.mass_kg() == 0) continue;
    shift = -1.3 * shift;
    joint.set_mass_kg(joint.mass_kg() * (1 + 5 * shift));
    joint.mutable_center_of_mass_m()->set_y(joint.center_of_mass_m().y() + shift);
    joint.set_inertia_kg_m2(3, shift * joint.inertia_kg_m2(0));
    joint.set_position_max(joint.position_max() + shift);
    joint.set_effort_max(joint.effort_max() * (1 + shift));
    mass += joint.mass_kg();
  }
  EXPECT_NE(MirrorDifference(model), "");
  const MirrorChange change = AverageMirrorImages(&model);
  EXPECT_EQ(MirrorDifference(model), "");
  EXPECT_GT(change.mass, 1e-3);
  EXPECT_GT(change.center, 1e-4);
  EXPECT_GT(change.limits, 1e-4);
  for (const v1::Joint& joint : model.joints()) averaged_mass += joint.mass_kg();
  EXPECT_NEAR(averaged_mass, mass, 1e-12);
  const MirrorChange again = AverageMirrorImages(&model);
  EXPECT_LT(std::max({again.mass, again.center, again.inertia, again.limits}), 1e-12);
}

}  // namespace
}  // namespace rollgait::client
