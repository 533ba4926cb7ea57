#include "client/principal_axes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace rollgait::client {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(PrincipalAxes, MomentsAndAxesMakeTheInertiaAgain) {
  const Matrix3d turn = (Eigen::AngleAxisd(0.7, Vector3d::UnitX()) * Eigen::AngleAxisd(-1.9, Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(2.4, Vector3d::UnitY()))
                            .toRotationMatrix();
  for (const Vector3d& moments : {Vector3d(1, 2, 3), Vector3d(0, 2, 2), Vector3d(4, 4, 4), Vector3d(1e-9, 5, 5)}) {
    const Matrix3d inertia = turn * moments.asDiagonal() * turn.transpose();
    const PrincipalAxes found = PrincipalAxesOf(inertia);
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * moments.maxCoeff();
    EXPECT_LE((found.moments - moments).cwiseAbs().maxCoeff(), rounding) << moments.transpose();
    EXPECT_LE((found.axes * found.moments.asDiagonal() * found.axes.transpose() - inertia).cwiseAbs().maxCoeff(),
              rounding);
    EXPECT_NEAR(found.axes.determinant(), 1, 1e-14);
  }
}

TEST(PrincipalAxes, AnInertiaThatIsNotFiniteHasNoMoments) {
  Matrix3d inertia = Matrix3d::Identity();
  inertia(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(PrincipalAxesOf(inertia).moments.array().isNaN().all());
}

}  // namespace
}  // namespace rollgait::client
