// The model of a URDF moves and weighs as the URDF does, in every posture.
#include "client/import/tree_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <random>

#include "client/failure.h"
#include "client/formats/body_links.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "tests/support/twisted_robot.h"

namespace rollgait::client {
namespace {

using testing::Contains;
using testing::HasSubstr;

struct Weight {
  double mass = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // Σ m r
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // Σ ∫ r rᵀ dm

  void Add(const Eigen::Isometry3d& place, double m, const Eigen::Vector3d& center, const Eigen::Matrix3d& inertia) {
    const Eigen::Vector3d r = place * center;
    const Eigen::Matrix3d spread = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
    mass += m;
    first += m * r;
    second += place.linear() * spread * place.linear().transpose() + m * r * r.transpose();
  }
};

// Where the tree's own numbers put its mass: nothing of lumped_links.h.
Weight WeightOfUrdf(const LinkTree& tree, const Eigen::Isometry3d& root, const std::map<std::string, double>& at,
                    std::map<std::string, Eigen::Isometry3d>* places) {
  Weight weight;
  const auto add = [&](int link, const Eigen::Isometry3d& place) {
    const TreeLink& from = tree.links[static_cast<size_t>(link)];
    (*places)[from.name] = place;
    weight.Add(place, from.mass.mass, from.mass.center, from.mass.inertia);
  };
  add(tree.root, root);
  for (const TreeJoint& joint : tree.joints) {
    Eigen::Isometry3d place = places->at(tree.links[static_cast<size_t>(joint.parent)].name);
    place.translate(joint.origin.position);
    place.rotate(joint.origin.rotation);
    const double position = at.count(joint.name) != 0 ? at.at(joint.name) : 0;
    if (joint.type == TreeJoint::Type::kPrismatic) place.translate(position * joint.axis);
    if (joint.type == TreeJoint::Type::kRevolute || joint.type == TreeJoint::Type::kContinuous) {
      place.rotate(Eigen::AngleAxisd(position, joint.axis));
    }
    add(joint.child, place);
  }
  return weight;
}

v1::SideContact* AddFoot(const std::string& name, const std::string& link, v1::ModelSideFile* side) {
  v1::SideContact* const contact = side->add_contacts();
  contact->set_name(name);
  contact->set_link(link);
  contact->set_side(name == "left" ? v1::BODY_SIDE_LEFT : v1::BODY_SIDE_RIGHT);
  v1::Vector3& axes = *contact->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
  axes.set_x(0.1);
  axes.set_y(0.05);
  axes.set_z(0.04);
  contact->mutable_center_m()->set_x(0.03);
  contact->mutable_center_m()->set_z(-0.02);
  return contact;
}

v1::SideJoint* AddSideJoint(const std::string& name, v1::ModelSideFile* side) {
  side->add_joints()->set_name(name);
  return side->mutable_joints(side->joints_size() - 1);
}

v1::ModelSideFile TwistedSide() {
  v1::ModelSideFile side;
  side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
  v1::SideJoint* const twist = AddSideJoint("twist", &side);
  twist->set_locked(true);
  twist->set_reference(0.4);
  AddSideJoint("hip", &side)->set_reference(0.3);
  AddSideJoint("knee", &side)->set_reference(-0.5);
  AddSideJoint("slide", &side)->set_reference(0.1);
  AddFoot("left", "slider", &side);
  AddFoot("right", "camera", &side);
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()));
  side.mutable_base_orientation()->set_w(q.w());
  side.mutable_base_orientation()->set_x(q.x());
  side.mutable_base_orientation()->set_y(q.y());
  side.mutable_base_orientation()->set_z(q.z());
  side.mutable_base_position_m()->set_z(0.9);
  return side;
}

int IndexOf(const v1::Model& model, const std::string& joint) {
  for (int i = 0; i < model.joints_size(); ++i) {
    if (model.joints(i).name() == joint) return i;
  }
  ADD_FAILURE() << joint;
  return 0;
}

TEST(UrdfModelTest, MovesAndWeighsAsTheUrdfInEveryPosture) {
  const LinkTree tree = ReadLinkTreeText("x.urdf", kTwistedRobot);
  const v1::ModelSideFile side = TwistedSide();
  CheckSideFile("x.json", side, tree);
  const v1::Model model = ModelOfTree(tree, "x.json", side).model;
  ASSERT_EQ(model.joints_size(), 9);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const v1::Quaternion& q = side.base_orientation();
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> position(9);
    for (double& value : position) value = trial == 0 ? 0 : uniform(random);
    // The base turns about its own chain of axes.
    Eigen::Isometry3d root = Eigen::Isometry3d::Identity();
    root.translate(Eigen::Vector3d(position[0], position[1], position[2] + 0.9));
    root.rotate(Eigen::AngleAxisd(position[3], Eigen::Vector3d::UnitZ()));
    root.rotate(Eigen::AngleAxisd(position[4], Eigen::Vector3d::UnitX()));
    root.rotate(Eigen::AngleAxisd(position[5], Eigen::Vector3d::UnitY()));
    root.rotate(Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()));
    std::map<std::string, Eigen::Isometry3d> places;
    const Weight expected = WeightOfUrdf(
        tree, root,
        {{"hip", 0.3 + position[6]}, {"twist", 0.4}, {"knee", -0.5 + position[7]}, {"slide", 0.1 + position[8]}},
        &places);
    const std::vector<Pose> poses = LinkPoses(model, position);
    Weight found;
    for (int i = 0; i < model.joints_size(); ++i) {
      Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
      place.translate(poses[static_cast<size_t>(i)].position);
      place.rotate(poses[static_cast<size_t>(i)].rotation);
      const LinkMass mass = MassOf(model.joints(i));
      found.Add(place, mass.mass, mass.center_of_mass, mass.inertia);
    }
    EXPECT_NEAR(found.mass, expected.mass, 1e-12);
    EXPECT_LT((found.first - expected.first).norm(), 1e-12);
    EXPECT_LT((found.second - expected.second).norm(), 1e-12);
    // The feet are where the URDF's links carry them, also the one on a merged link.
    for (const v1::ContactSurface& contact : model.contacts()) {
      const Pose& link = poses[static_cast<size_t>(contact.joint())];
      const Eigen::Isometry3d carrier = places.at(contact.name() == "left" ? "slider" : "camera");
      EXPECT_LT(
          (link.position + link.rotation * ToVector(contact.center_m()) - carrier * Eigen::Vector3d(0.03, 0, -0.02))
              .norm(),
          1e-12);
      EXPECT_LT((link.rotation * ToRotation(contact.orientation()) - carrier.linear()).norm(), 1e-12);
    }
  }
}

TEST(UrdfModelTest, RangesCountFromTheReference) {
  const LinkTree tree = ReadLinkTreeText("x.urdf", kTwistedRobot);
  const ImportedModel urdf = ModelOfTree(tree, "x.json", TwistedSide());
  const v1::Joint& hip = urdf.model.joints(IndexOf(urdf.model, "hip"));
  EXPECT_DOUBLE_EQ(hip.position_min(), -1.3);
  EXPECT_DOUBLE_EQ(hip.position_max(), 1.7);
  EXPECT_EQ(hip.effort_min(), -50);
  EXPECT_EQ(hip.velocity_max(), 8);
  EXPECT_TRUE(hip.actuated());
  const v1::Joint& knee = urdf.model.joints(IndexOf(urdf.model, "knee"));
  EXPECT_NEAR(knee.position_max(), M_PI, 1e-15);
  EXPECT_THAT(urdf.assumed, Contains(HasSubstr("range of joint \"knee\", which is continuous")));
  EXPECT_THAT(urdf.model.sources(), Contains(HasSubstr("Assumed: range of joint \"knee\"")));
  EXPECT_THAT(urdf.merged, Contains(HasSubstr("\"motor\" into \"thigh\": joint \"twist\" is locked at 0.4")));
  EXPECT_THAT(urdf.read, Contains(HasSubstr("7 links, 6 joints, 12.6 kg")));
}

std::string RefusalOf(const std::string& urdf, const v1::ModelSideFile& side) {
  try {
    const LinkTree tree = ReadLinkTreeText("x.urdf", urdf);
    CheckSideFile("x.json", side, tree);
    ModelOfTree(tree, "x.json", side);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    return failure.what();
  }
  return "accepted";
}

std::string With(const std::string& from, const std::string& to) {
  std::string text = kTwistedRobot;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

TEST(UrdfModelTest, SaysWhatAModelCannotHave) {
  const v1::ModelSideFile good = TwistedSide();
  EXPECT_EQ(RefusalOf(kTwistedRobot, good), "accepted");
  EXPECT_THAT(RefusalOf(With("effort=\"50\" velocity=\"8\"", "effort=\"0\" velocity=\"8\""), good),
              HasSubstr("<joint name=\"hip\">: effort is limited to 0 … 0"));
  EXPECT_THAT(RefusalOf(With("<limit effort=\"40\" velocity=\"9\"/>", "<mimic joint=\"hip\"/>"), good),
              HasSubstr("<joint name=\"knee\">: mimics \"hip\", which a model cannot express"));
  EXPECT_THAT(RefusalOf(With("name=\"slide\" type=\"prismatic\"", "name=\"slide\" type=\"planar\""), good),
              HasSubstr("<joint name=\"slide\">: is planar"));
  EXPECT_THAT(RefusalOf(With("name=\"slide\" type=\"prismatic\"", "name=\"slide\" type=\"floating\""), good),
              HasSubstr("a floating joint must be the first of the tree"));
  EXPECT_THAT(RefusalOf(With("joint name=\"slide\"", "joint name=\"slide it\""), good),
              HasSubstr("\"slide\" is no joint"));
  // An inertia that no body has is no harm where its link is merged.
  const std::string thin = With("<inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" iyy=\"0.002\" iyz=\"0\" izz=\"0.0015\"/>",
                                "<inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" iyy=\"0.002\" iyz=\"0\" izz=\"0.004\"/>");
  EXPECT_EQ(RefusalOf(thin, good), "accepted");
  v1::ModelSideFile side = good;
  side.mutable_joints(0)->set_locked(false);
  EXPECT_THAT(RefusalOf(thin, side),
              HasSubstr("<link name=\"motor\">: with what is merged into it, it has the principal moments 0.001, "
                        "0.002 and 0.004 kg m²; no body has one above the sum of the two others"));
  side = good;
  side.mutable_joints(1)->set_reference(2.5);
  EXPECT_THAT(RefusalOf(kTwistedRobot, side), HasSubstr("its reference in x.json is 2.5, out of its range -1 to 2"));
  side = good;
  side.clear_base_orientation();
  side.clear_base_position_m();
  side.mutable_joints(1)->set_role(v1::Joint::ROLE_BASE_PITCH);
  EXPECT_THAT(RefusalOf(kTwistedRobot, side), HasSubstr("<link name=\"base\">: has mass, but no joint of the base"));
  side = good;
  side.set_name("");
  EXPECT_THAT(RefusalOf(With("robot name=\"twisted\"", "robot name=\"my robot\""), side),
              HasSubstr("the name of the robot \"my robot\" must be 1 to 64 letters"));
}

// The robot on a floating joint, with something beside it.
std::string Floating(const std::string& beside) {
  return With("<link name=\"camera\"/>",
              "<link name=\"camera\"/><link name=\"world\"/><joint name=\"free\" type=\"floating\">"
              "<parent link=\"world\"/><child link=\"base\"/><origin xyz=\"0 0 1\"/></joint>" +
                  beside);
}

TEST(UrdfModelTest, AFloatingJointAtTheRootIsTheBase) {
  const ImportedModel urdf_model = ModelOfTree(ReadLinkTreeText("x.urdf", Floating("")), "x.json", TwistedSide());
  EXPECT_EQ(urdf_model.model.joints_size(), 9);
  EXPECT_EQ(urdf_model.model.joints(5).link_name(), "base");
  EXPECT_THAT(urdf_model.read, Contains(HasSubstr("joint \"free\" is the floating base")));
}

TEST(UrdfModelTest, BesideTheFloatingJointNothingWeighsOrMoves) {
  const auto beside = [](const std::string& type, const std::string& link) {
    return Floating("<link name=\"door\">" + link + "</link><joint name=\"hinge\" type=\"" + type +
                    "\"><parent link=\"world\"/><child link=\"door\"/><axis xyz=\"0 0 1\"/></joint>");
  };
  const std::string mass =
      "<inertial><mass value=\"7\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";
  v1::ModelSideFile side = TwistedSide();
  EXPECT_EQ(RefusalOf(beside("fixed", ""), side), "accepted");
  EXPECT_THAT(
      RefusalOf(beside("fixed", mass), side),
      HasSubstr("<joint name=\"hinge\">: is not behind the floating joint \"free\", so it is part of the world, "
                "but its link \"door\" has a mass of 7 kg"));
  EXPECT_THAT(
      RefusalOf(beside("continuous", ""), side),
      HasSubstr("<joint name=\"hinge\">: is not behind the floating joint \"free\", so it is part of the world, "
                "which does not move"));
  EXPECT_THAT(
      RefusalOf(beside("floating", mass), side),
      HasSubstr("<joint name=\"hinge\">: is floating, and so is joint \"free\"; a model has one floating base"));
  side.set_base(v1::ModelSideFile::BASE_PLANE);
  EXPECT_THAT(RefusalOf(beside("continuous", ""), side), HasSubstr("which does not move"));
  AddSideJoint("hinge", &side)->set_locked(true);
  EXPECT_EQ(RefusalOf(beside("continuous", ""), side), "accepted");
  EXPECT_THAT(RefusalOf(beside("continuous", mass), side), HasSubstr("has a mass of 7 kg"));
}

TEST(UrdfModelTest, NamesOfLinksAreChecked) {
  for (std::string urdf : {std::string(kTwistedRobot), Floating("")}) {
    for (size_t at = 0; (at = urdf.find("\"base\"", at)) != std::string::npos;) urdf.replace(at, 6, "\"the base\"");
    EXPECT_THAT(RefusalOf(urdf, TwistedSide()), HasSubstr("the link \"the base\" must be 1 to 64 letters"));
  }
}

TEST(UrdfModelTest, ALongNameOfTheRobotStaysUtf8) {
  std::string name = "x";
  for (int i = 0; i < 120; ++i) name += "ü";
  v1::ModelSideFile side = TwistedSide();
  side.set_name("twisted");
  const LinkTree tree = ReadLinkTreeText("x.urdf", With("robot name=\"twisted\"", "robot name=\"" + name + "\""));
  EXPECT_EQ(ModelOfTree(tree, "x.json", side).model.summary().description(), "Robot " + name + ", read from URDF.");
}

}  // namespace
}  // namespace rollgait::client
