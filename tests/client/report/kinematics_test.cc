#include "client/report/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

TEST(LinkPosesTest, StraightLegAndBentKnee) {
  const v1::Model model = SampleModel();
  std::vector<double> q(9, 0.0);
  q[0] = 1.5;
  q[1] = 0.9;
  std::vector<Pose> poses = LinkPoses(model, q);
  EXPECT_NEAR(poses[5].position.x(), 1.5, 1e-12);
  EXPECT_NEAR(poses[5].position.z(), 0.9 - 0.86, 1e-12);
  // Hip flexion (about −y) of 90° puts the thigh forward; the knee flexed by 90° (about +y) hangs the shank down again.
  q[3] = q[4] = M_PI / 2;
  poses = LinkPoses(model, q);
  EXPECT_NEAR(poses[4].position.x(), 1.5 + 0.43, 1e-12);
  EXPECT_NEAR(poses[4].position.z(), 0.9, 1e-12);
  EXPECT_NEAR(poses[5].position.x(), 1.5 + 0.43, 1e-12);
  EXPECT_NEAR(poses[5].position.z(), 0.9 - 0.43, 1e-12);
  EXPECT_NEAR(poses[5].position.y(), 0.08, 1e-12);
}

TEST(LinkPosesTest, RefusesWrongSizeAndOrder) {
  v1::Model model = SampleModel();
  EXPECT_THROW(LinkPoses(model, {0, 0}), Failure);
  model.mutable_joints(1)->set_parent(5);
  EXPECT_THROW(LinkPoses(model, std::vector<double>(9, 0.0)), Failure);
}

// The lowest point against the surface sampled densely.
TEST(LowestPointTest, IsThatOfTheSampledSurface) {
  v1::Model model = SampleModel();
  v1::ContactSurface& foot = *model.mutable_contacts(0);
  // A general placement: turned about an oblique axis.
  foot.mutable_orientation()->set_w(std::cos(0.4));
  foot.mutable_orientation()->set_x(std::sin(0.4) * 0.48);
  foot.mutable_orientation()->set_y(std::sin(0.4) * 0.6);
  foot.mutable_orientation()->set_z(std::sin(0.4) * 0.64);
  std::vector<double> q(9, 0.0);
  q[5] = 0.3;
  const std::vector<Pose> poses = LinkPoses(model, q);
  const Eigen::Vector3d found = LowestPoint(foot, poses);

  // The same ellipsoid point by point, with the rotation matrix written out by Rodrigues' formula.
  const Eigen::Vector3d axis(0.48, 0.6, 0.64);
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Eigen::Matrix3d turn =
      Eigen::Matrix3d::Identity() + std::sin(0.8) * cross + (1 - std::cos(0.8)) * cross * cross;
  Eigen::Vector3d lowest(0, 0, 1e9);
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j < 800; ++j) {
      const double u = M_PI * i / 400, w = 2 * M_PI * j / 800;
      const Eigen::Vector3d local(0.13 * std::sin(u) * std::cos(w), 0.05 * std::sin(u) * std::sin(w),
                                  0.06 * std::cos(u));
      const Eigen::Vector3d p =
          poses[5].position + poses[5].rotation * (Eigen::Vector3d(0.07, 0, -0.02) + turn * local);
      if (p.z() < lowest.z()) lowest = p;
    }
  }
  // Sampling steps of 8 mrad: the extreme points are met to 1e-5 of their height, 1e-3 m of their place.
  EXPECT_NEAR(found.z(), lowest.z(), 1e-5);
  EXPECT_NEAR(found.x(), lowest.x(), 2e-3);
  EXPECT_NEAR(found.y(), lowest.y(), 2e-3);
}

TEST(PositiveDirectionTest, NamesFlexion) {
  const v1::Model model = SampleModel();
  EXPECT_EQ(PositiveDirection(model, 0), "forward");
  EXPECT_EQ(PositiveDirection(model, 1), "up");
  EXPECT_EQ(PositiveDirection(model, 3), "forward");   // hip
  EXPECT_EQ(PositiveDirection(model, 4), "backward");  // knee
  EXPECT_EQ(PositiveDirection(model, 5), "up");        // ankle: toes up
}

}  // namespace
}  // namespace rollgait::client
