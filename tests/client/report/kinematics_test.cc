#include "client/report/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "client/report/surface_shape.h"
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

// A superellipsoid lies between the planes that its lowest points say: none of its points is lower than the lowest.
TEST(LowestPointTest, OfASuperellipsoidIsLowestOfItsPoints) {
  v1::Model model = SampleModel();
  v1::ContactSurface& foot = *model.mutable_contacts(0);
  const v1::Vector3 axes = foot.surface().ellipsoid().semi_axes_m();
  v1::Superellipsoid& super = *foot.mutable_surface()->mutable_superellipsoid();
  *super.mutable_semi_axes_m() = axes;
  super.set_exponent_1(0.7);
  super.set_exponent_2(1.3);
  super.set_smoothing(0.1);
  const SurfaceShape shape = ShapeOf(foot.surface());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(shape.FurthestPoint(Eigen::Vector3d::Unit(i))[i], shape.semi_axes[i], 1e-15);
  }
  // The furthest point is on the plane that the definition of the support function says.
  const auto norm = [](const Eigen::Vector3d& t) {
    const Eigen::Vector3d n = (t.array().square() + 0.01 * t.squaredNorm()).sqrt();
    const double q_1 = 2 / 1.3, q_2 = 2 / 0.7;
    const double around = std::pow(std::pow(n.x(), q_2) + std::pow(n.y(), q_2), 1 / q_2);
    return std::pow(std::pow(around, q_1) + std::pow(n.z(), q_1), 1 / q_1);
  };
  const Eigen::Vector3d toward(0.48, -0.6, 0.64), shares(norm({1, 0, 0}), norm({0, 1, 0}), norm({0, 0, 1}));
  EXPECT_NEAR(shape.FurthestPoint(toward).dot(toward), norm(shape.semi_axes.cwiseQuotient(shares).cwiseProduct(toward)),
              1e-15);
  std::vector<double> q(9, 0.0);
  q[5] = 0.3;
  const std::vector<Pose> poses = LinkPoses(model, q);
  const Eigen::Matrix3d rotation = poses[5].rotation * ToRotation(foot.orientation());
  const Eigen::Vector3d found = LowestPoint(foot, poses);
  const double height = found.z();
  double lowest = 1e9;
  for (int i = 0; i <= 200; ++i) {
    for (int j = 0; j < 400; ++j) {
      const double u = M_PI * i / 200, w = 2 * M_PI * j / 400;
      const Eigen::Vector3d direction(std::sin(u) * std::cos(w), std::sin(u) * std::sin(w), std::cos(u));
      const Eigen::Vector3d p =
          poses[5].position + poses[5].rotation * ToVector(foot.center_m()) + rotation * shape.FurthestPoint(direction);
      lowest = std::min(lowest, p.z());
    }
  }
  EXPECT_GE(lowest, height - 1e-15);
  EXPECT_NEAR(lowest, height, 1e-5);
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
