#include "client/rotation_of_z.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace rollgait::client {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// By a second way: the angle and the axis z × d of Eigen's quaternions, where that axis is well defined.
TEST(RotationOfZ, IsTheShortestRotationToTheDirection) {
  for (const Vector3d& direction :
       {Vector3d(1, 0, 0), Vector3d(0, -2, 0), Vector3d(0.3, -0.4, 0.5), Vector3d(3, 1, -7), Vector3d(1e-6, 2e-6, 1),
        Vector3d(1e-5, -3e-5, -1), Vector3d(3e200, 4e200, 5e200)}) {
    const Vector3d d = direction.stableNormalized();
    const double angle = std::atan2(std::hypot(d.x(), d.y()), d.z());
    const Matrix3d expected = Eigen::AngleAxisd(angle, Vector3d(-d.y(), d.x(), 0).normalized()).toRotationMatrix();
    EXPECT_LE((RotationOfZTo(direction) - expected).cwiseAbs().maxCoeff(), 1e-15) << direction.transpose();
  }
}

TEST(RotationOfZ, IsARotationNextToBothEnds) {
  EXPECT_EQ(RotationOfZTo({0, 0, 3}), Matrix3d::Identity());
  EXPECT_EQ(RotationOfZTo({0, 0, -3}), Matrix3d(Vector3d(1, -1, -1).asDiagonal()));
  for (const double z : {1.0, -1.0}) {
    for (const double small : {1e-6, 1e-5, 1e-4}) {
      const Matrix3d rotation = RotationOfZTo({small, -2 * small, z});
      EXPECT_LE((rotation * rotation.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15) << small;
      EXPECT_NEAR(rotation.determinant(), 1, 1e-15);
      EXPECT_EQ(rotation.col(2), Vector3d(small, -2 * small, z).stableNormalized());
    }
    for (const double small : {1e-300, 1e-16, 1e-9}) {
      EXPECT_EQ(RotationOfZTo({small, -2 * small, z}), RotationOfZTo({0, 0, z})) << small;
    }
  }
}

}  // namespace
}  // namespace rollgait::client
