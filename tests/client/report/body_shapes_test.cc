#include "client/report/body_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::Contains;
using testing::Key;

std::map<std::string, BodyShape> ByPart(const v1::Model& model) {
  std::map<std::string, BodyShape> parts;
  for (const BodyShape& shape : BodyShapes(model)) EXPECT_TRUE(parts.emplace(shape.part, shape).second) << shape.part;
  return parts;
}

TEST(BodyShapesTest, ContactsComeFirstAndAreTheModels) {
  const v1::Model model = SampleModel();
  const std::vector<BodyShape> shapes = BodyShapes(model);
  ASSERT_GE(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].part, "left foot");
  EXPECT_EQ(shapes[0].kind, ShapeKind::kContact);
  EXPECT_EQ(shapes[0].side, Side::kLeft);
  EXPECT_EQ(shapes[0].semi_axes, Eigen::Vector3d(0.13, 0.05, 0.06));
  EXPECT_EQ(shapes[0].pose.position, Eigen::Vector3d(0.07, 0, -0.02));
  EXPECT_EQ(shapes[1].side, Side::kRight);
}

// A person and not sticks: a head whose top is at stature, a trunk, and legs that reach from joint to joint.
TEST(BodyShapesTest, DrawsAPerson) {
  const v1::Model model = SampleModel();
  const std::map<std::string, BodyShape> parts = ByPart(model);
  for (const char* const part : {"head", "neck", "chest", "abdomen", "pelvis", "right thigh", "left shank"}) {
    EXPECT_THAT(parts, Contains(Key(std::string(part))));
    EXPECT_EQ(parts.at(part).kind, ShapeKind::kDrawn);
  }
  const BodyShape& head = parts.at("head");
  EXPECT_EQ(head.side, Side::kMiddle);
  EXPECT_NEAR(head.pose.position.z() + head.semi_axes.z(), model.stature_m() - model.leg_length_m(), 1e-12);
  const BodyShape& shank = parts.at("left shank");
  EXPECT_NEAR(shank.pose.position.z(), -0.43 / 2, 1e-12);
  EXPECT_GE(shank.semi_axes.z(), 0.43 / 2);
  EXPECT_EQ(shank.side, Side::kLeft);
}

// A surface of the model takes the place of what would be drawn.
TEST(BodyShapesTest, SurfacesOfTheModelAreDrawnAsTheyAre) {
  v1::Model model = SampleModel();
  v1::BodySurface& body = *model.add_bodies();
  body.set_name("left_shank");
  body.set_joint(4);
  body.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->set_x(0.06);
  body.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->set_z(0.2);
  body.mutable_center_m()->set_z(-0.2);
  v1::BodySurface& foot = *model.add_bodies();  // contacts are among the bodies, and drawn once
  foot.set_name("left_foot");
  foot.set_joint(5);
  const std::map<std::string, BodyShape> parts = ByPart(model);
  EXPECT_EQ(parts.at("left shank").kind, ShapeKind::kBody);
  EXPECT_EQ(parts.at("left shank").semi_axes.x(), 0.06);
  EXPECT_EQ(parts.at("left foot").kind, ShapeKind::kContact);
}

// An own model has no stature: its trunk is where its hips and its centre of mass are.
TEST(BodyShapesTest, DrawsTheMiddleOfABodyOfUnknownStature) {
  v1::Model model = SampleModel();
  model.clear_stature_m();
  const int trunk = 2;
  model.mutable_joints(trunk)->mutable_center_of_mass_m()->set_z(0.3);
  const std::string part = model.joints(trunk).link_name();
  const BodyShape drawn = ByPart(model).at(part);
  EXPECT_EQ(drawn.joint, trunk);
  EXPECT_EQ(drawn.side, Side::kMiddle);
  EXPECT_LE(drawn.pose.position.z() - drawn.semi_axes.z(), 0);
  EXPECT_GE(drawn.pose.position.z() + drawn.semi_axes.z(), 0.3 - 1e-12);
  EXPECT_GE(drawn.semi_axes.y(), 0.08 - 1e-12) << "the hips";
  EXPECT_GT(drawn.semi_axes.x(), 0.02) << "no plate";

  v1::BodySurface& body = *model.add_bodies();
  body.set_name("hand");
  body.set_joint(trunk);
  for (const auto set : {&v1::Vector3::set_x, &v1::Vector3::set_y, &v1::Vector3::set_z}) {
    (body.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->*set)(0.05);
  }
  body.mutable_center_m()->set_y(0.25);
  EXPECT_THAT(ByPart(model), Contains(Key(part))) << "a hand at its side does not show it";
  body.mutable_center_m()->set_y(0);
  EXPECT_THAT(ByPart(model), testing::Not(Contains(Key(part)))) << "what the model says is drawn in its place";
}

// Shanks that stand on points: the point does not show the shank.
TEST(BodyShapesTest, DrawsALimbWhoseOnlySurfaceIsAtItsEnd) {
  v1::Model model = SampleModel();
  const int shank = 4;
  v1::ContactSurface& foot = *model.mutable_contacts(0);
  foot.set_joint(shank);
  for (const auto set : {&v1::Vector3::set_x, &v1::Vector3::set_y, &v1::Vector3::set_z}) {
    (foot.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m()->*set)(0.02);
  }
  foot.mutable_center_m()->set_x(0);
  foot.mutable_center_m()->set_z(-0.4);
  model.mutable_joints()->DeleteSubrange(5, model.joints_size() - 5);  // no foot, no other leg
  model.mutable_contacts()->DeleteSubrange(1, model.contacts_size() - 1);
  const BodyShape drawn = ByPart(model).at("left shank");
  EXPECT_EQ(drawn.kind, ShapeKind::kDrawn);
  EXPECT_NEAR(drawn.pose.position.z(), -0.2, 1e-12) << "from the knee to the point";
  EXPECT_GE(drawn.semi_axes.z(), 0.2);
}

// A surface whose longest axis reaches 0.1 m to either side spans 0.2 m of the way from the knee to its far side: of
// 0.39 m more than half, of 0.41 m less.
TEST(BodyShapesTest, ASurfaceShowsALimbOfWhichItSpansHalf) {
  const auto is_drawn = [](double depth, double longest) {
    v1::Model model = SampleModel();
    v1::BodySurface& body = *model.add_bodies();
    body.set_name("calf");
    body.set_joint(4);
    v1::Vector3& axes = *body.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
    axes.set_x(0.01);
    axes.set_y(longest);
    axes.set_z(0.01);
    body.mutable_center_m()->set_z(-depth);
    return ByPart(model).count("left shank") != 0;
  };
  EXPECT_FALSE(is_drawn(0, 0.1));
  EXPECT_FALSE(is_drawn(0.29, 0.1));
  EXPECT_TRUE(is_drawn(0.31, 0.1));
  EXPECT_TRUE(is_drawn(0.29, 0.09));
}

TEST(BodyShapesTest, RefusesASurfaceOnNoJoint) {
  v1::Model model = SampleModel();
  model.mutable_contacts(0)->set_joint(9);
  EXPECT_THROW(BodyShapes(model), Failure);
}

// Arms hang on their own side; once both were drawn in the colour of the left leg.
TEST(JointSidesTest, ArmsHaveTheirOwnSides) {
  v1::Model model = SampleModel();
  const int trunk = 2;
  for (const char* const name : {"shoulder_r", "elbow_r", "shoulder_l", "elbow_l"}) {
    v1::Joint& joint = *model.add_joints();
    joint.set_name(name);
    joint.set_parent(joint.name().starts_with("shoulder") ? trunk : model.joints_size() - 2);
    joint.set_mirror_joint(model.joints_size() - 1);
  }
  const std::vector<Side> sides = JointSides(model);
  EXPECT_EQ(sides[trunk], Side::kMiddle);
  EXPECT_EQ(sides[3], Side::kLeft);
  EXPECT_EQ(sides[8], Side::kRight);
  EXPECT_EQ(sides[9], Side::kRight);
  EXPECT_EQ(sides[10], Side::kRight);
  EXPECT_EQ(sides[11], Side::kLeft);
  EXPECT_EQ(sides[12], Side::kLeft);
}

// Names without a side: mirror images of each other are told apart by where they are.
TEST(JointSidesTest, PlacesTellSidesWhereNamesDoNot) {
  v1::Model model = SampleModel();
  model.mutable_joints(3)->set_name("first");
  model.mutable_joints(6)->set_name("second");
  const std::vector<Side> sides = JointSides(model);
  EXPECT_EQ(sides[3], Side::kLeft);  // at y = 0.08 m
  EXPECT_EQ(sides[6], Side::kRight);
}

}  // namespace
}  // namespace rollgait::client
