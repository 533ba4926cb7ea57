// Mirror images of joints whose names tell no side.
#include "client/import/mirror_images.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

using Eigen::Vector3d;

const Vector3d kMirror(1, -1, 1);

void Set(const Vector3d& from, v1::Vector3* to) {
  to->set_x(from.x());
  to->set_y(from.y());
  to->set_z(from.z());
}

// Adds a joint on `parent` at `place` along or about `axis`, both in the world: its frame is turned by `turn` (rad)
// about z, and those of its parents are as they are.
int Add(v1::Model* model, const std::string& name, v1::Joint::Type type, int parent, const Vector3d& place,
        const Vector3d& axis, double mass, double turn) {
  std::vector<Pose> poses = LinkPoses(*model, std::vector<double>(static_cast<size_t>(model->joints_size()), 0.0));
  const Pose under =
      parent < 0 ? Pose{Eigen::Matrix3d::Identity(), Vector3d::Zero()} : poses[static_cast<size_t>(parent)];
  const Eigen::Matrix3d frame = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Quaterniond q(under.rotation.transpose() * frame);
  v1::Joint& joint = *model->add_joints();
  joint.set_name(name);
  joint.set_type(type);
  joint.set_parent(parent);
  Set(under.rotation.transpose() * (place - under.position), joint.mutable_origin_m());
  Set(frame.transpose() * axis, joint.mutable_axis());
  joint.mutable_orientation()->set_w(q.w());
  joint.mutable_orientation()->set_x(q.x());
  joint.mutable_orientation()->set_y(q.y());
  joint.mutable_orientation()->set_z(q.z());
  joint.set_mass_kg(mass);
  return model->joints_size() - 1;
}

constexpr auto kTurn = v1::Joint::TYPE_REVOLUTE, kSlide = v1::Joint::TYPE_PRISMATIC;
constexpr double kDegree = 3.14159265358979323846 / 180;

v1::Model Body() {
  v1::Model model;
  Add(&model, "trunk", kTurn, -1, Vector3d(0, 0, 1), Vector3d::UnitY(), 30, 0);
  return model;
}

// Where the link of `joint` carries a point of the world when `joint` alone is moved.
Vector3d Carried(const v1::Model& model, int joint, double position, const Vector3d& point) {
  std::vector<double> positions(static_cast<size_t>(model.joints_size()), 0.0);
  const auto link = static_cast<size_t>(joint);
  const Pose rest = LinkPoses(model, positions)[link];
  positions[link] = position;
  const Pose moved = LinkPoses(model, positions)[link];
  return moved.rotation * (rest.rotation.transpose() * (point - rest.position)) + moved.position;
}

// A joint and its image, moved alike, carry mirrored points to mirrored places.
void ExpectMirrored(const v1::Model& model, int joint) {
  const v1::Joint& from = model.joints(joint);
  const Vector3d point(0.3, 0.4, -0.2);
  const Vector3d moved = Carried(model, joint, 0.3, point);
  const Vector3d image = Carried(model, from.mirror_joint(), 0.3 * from.mirror_sign(), kMirror.cwiseProduct(point));
  EXPECT_LT((kMirror.cwiseProduct(moved) - image).norm(), 1e-12) << from.name();
}

// Axes along x, across and oblique; images whose axes point along the mirrored one or against it.
TEST(ImagesByPlaceTest, MoveAsMirrorImages) {
  for (const v1::Joint::Type type : {kTurn, kSlide}) {
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0.6, 0.8, 0)}) {
      for (const double sign : {1.0, -1.0}) {
        v1::Model model = Body();
        const Vector3d hip(0.1, 0.2, 0.9), knee(0.15, 0.25, 0.5);
        const auto image = [&](const Vector3d& v) { return Vector3d(kMirror.cwiseProduct(v)); };
        const int one = Add(&model, "one", type, 0, hip, axis, 5, 0.3);
        const int two = Add(&model, "two", type, 0, image(hip), sign * image(axis), 5, -0.8);
        const int three = Add(&model, "three", type, two, image(knee), image(axis), 2, 0);
        const int four = Add(&model, "four", type, one, knee, sign * axis, 2, 0.1);
        SetMirrorImages("s.json", {}, &model);
        EXPECT_EQ(model.joints(one).mirror_joint(), two);
        EXPECT_EQ(model.joints(two).mirror_joint(), one);
        EXPECT_EQ(model.joints(three).mirror_joint(), four);
        EXPECT_EQ(model.joints(four).mirror_joint(), three);
        EXPECT_EQ(model.joints(0).mirror_joint(), 0);
        for (int i = 0; i < model.joints_size(); ++i) ExpectMirrored(model, i);
      }
    }
  }
}

// One and its image, of which the second is as given.
struct Second {
  std::string name = "two";
  v1::Joint::Type type = kTurn;
  int parent = 0;
  double forward = 0;  // m, of its place
  double turn = 0;     // rad, of its axis
  double mass = 5;
};

bool AreImages(const Second& second) {
  v1::Model model = Body();
  const Vector3d place(0.1, 0.2, 0.9), axis(0.6, 0.8, 0);
  Add(&model, "spine", kTurn, 0, Vector3d(0, 0, 1.2), Vector3d::UnitY(), 3, 0);
  const int one = Add(&model, "one", kTurn, 0, place, axis, 5, 0);
  const Eigen::AngleAxisd turned(second.turn, Vector3d::UnitZ());
  const int two =
      Add(&model, second.name, second.type, second.parent, kMirror.cwiseProduct(place) + Vector3d(second.forward, 0, 0),
          turned * Vector3d(kMirror.cwiseProduct(axis)), second.mass, 0);
  SetMirrorImages("s.json", {}, &model);
  const bool are = model.joints(one).mirror_joint() == two;
  EXPECT_EQ(model.joints(one).mirror_joint(), are ? two : one);
  EXPECT_EQ(model.joints(two).mirror_joint(), are ? one : two) << "images of each other, or each of itself";
  return are;
}

// Drawings are rounded to what the header says; what differs by more is no image.
TEST(ImagesByPlaceTest, ImagesAgreeInPlaceAxisMassTypeAndParent) {
  EXPECT_TRUE(AreImages({}));
  EXPECT_TRUE(AreImages({.forward = 0.0009}));
  EXPECT_FALSE(AreImages({.forward = 0.0011}));
  EXPECT_TRUE(AreImages({.turn = 2 * kDegree}));
  EXPECT_FALSE(AreImages({.turn = 3 * kDegree}));
  EXPECT_TRUE(AreImages({.mass = 5.045}));
  EXPECT_FALSE(AreImages({.mass = 5.055}));
  EXPECT_FALSE(AreImages({.type = kSlide}));
  EXPECT_FALSE(AreImages({.parent = 1}));
  EXPECT_FALSE(AreImages({.name = "right_two"})) << "its name says whose image it is";
}

TEST(ImagesByPlaceTest, OfTwoAlikeNoneIsChosen) {
  v1::Model model = Body();
  for (const double side : {1.0, -1.0, -1.0}) {
    const std::string name = "j" + std::to_string(model.joints_size());
    Add(&model, name, kTurn, 0, Vector3d(0.1, side * 0.2, 0.9), Vector3d::UnitY(), 5, 0);
  }
  SetMirrorImages("s.json", {}, &model);
  EXPECT_EQ(model.joints(1).mirror_joint(), 1);
}

// Two rotors in one place of the plane of x and z are not each other's images.
TEST(ImagesByPlaceTest, JointsInThePlaneAreTheirOwn) {
  v1::Model model = Body();
  const int one = Add(&model, "rotor", kTurn, 0, Vector3d(0.1, 0, 1.1), Vector3d::UnitY(), 2, 0);
  const int two = Add(&model, "counter", kTurn, 0, Vector3d(0.1, 0, 1.1), Vector3d::UnitY(), 2, 0);
  SetMirrorImages("s.json", {}, &model);
  EXPECT_EQ(model.joints(one).mirror_joint(), one);
  EXPECT_EQ(model.joints(two).mirror_joint(), two);
}

}  // namespace
}  // namespace rollgait::client
