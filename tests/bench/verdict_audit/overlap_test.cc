#include "bench/verdict_audit/overlap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace rollgait::audit {
namespace {

WorldBody Body(const Vector3& center, const Vector3& semi_axes, const Matrix3& turned = Matrix3::Identity()) {
  return {center, turned, {semi_axes}};
}

double Depth(const WorldBody& first, const WorldBody& second, Vector3 direction = Vector3::UnitY()) {
  return Overlap(first, second, &direction);
}

TEST(Overlap, OfSpheres) {
  const Vector3 axes = Vector3::Constant(0.1);
  EXPECT_NEAR(Depth(Body(Vector3::Zero(), axes), Body(Vector3(0.09, 0.12, 0), axes)), 0.05, 1e-12);
  EXPECT_EQ(Depth(Body(Vector3::Zero(), axes), Body(Vector3(0.15, 0.14, 0), axes)), 0);
}

// A small sphere whose centre is 30 mm beyond the tip of a long ellipsoid, wherever the two are turned.
TEST(Overlap, OfAnEllipsoidAtItsTip) {
  for (const double angle : {0.0, 0.7, 2.1}) {
    const Matrix3 R = Eigen::AngleAxisd(angle, Vector3(1, 2, -1).normalized()).toRotationMatrix();
    const WorldBody limb = Body(Vector3(1, 2, 3), Vector3(0.3, 0.1, 0.1), R);
    const WorldBody ball = Body(Vector3(1, 2, 3) + R * Vector3(0.33, 0, 0), Vector3::Constant(0.05));
    EXPECT_NEAR(Depth(limb, ball), 0.02, 1e-9) << angle;
    EXPECT_NEAR(Depth(ball, limb, Vector3::UnitZ()), 0.02, 1e-9) << angle;
  }
}

// Two crossed ellipsoids with one centre: the shortest way out is along the common third axis.
TEST(Overlap, OfCrossedEllipsoids) {
  const Matrix3 quarter = Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 axes(0.3, 0.1, 0.04);
  EXPECT_NEAR(Depth(Body(Vector3::Zero(), axes), Body(Vector3(0, 0, 0.01), axes, quarter)), 0.07, 1e-9);
}

// The second judge's superellipsoid is the one of the first, by other formulas.
TEST(SmoothBody, IsTheSurface) {
  const Surface surface = SmoothSuperellipsoid(Vector3(0.06, 0.05, 0.02), 0.7, 1.4, 0.1);
  const SmoothBody body = BodyOf(surface);
  for (const Vector3& direction : {Vector3(0, 0, -1), Vector3(0.6, 0, -0.8), Vector3(0.48, -0.6, 0.64)}) {
    EXPECT_NEAR(body.Support(direction), surface.Support(direction), 1e-16);
    EXPECT_LT((body.Furthest(direction) - surface.SupportPoint(direction)).norm(), 1e-15);
  }
  const Vector3 axes(0.3, 0.2, 0.1), up(0.48, -0.6, 0.64);
  EXPECT_LT((BodyOf(Ellipsoid(axes)).Furthest(up) - Ellipsoid(axes).SupportPoint(up)).norm(), 1e-15);
}

TEST(Overlap, StartsWhereItEnded) {
  const Vector3 axes = Vector3::Constant(0.1);
  Vector3 direction = Vector3::UnitY();
  Overlap(Body(Vector3::Zero(), axes), Body(Vector3(0.15, 0, 0), axes), &direction);
  EXPECT_NEAR(direction.x(), 1, 1e-9);
}

}  // namespace
}  // namespace rollgait::audit
