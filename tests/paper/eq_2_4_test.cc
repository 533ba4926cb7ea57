// Eq. (2.4): the rolling constraint g(T₁, t₁, T₂, t₂) = 0 depends on the placements of the two bodies and their twists
// only. In the twists it is linear, it vanishes when both move as one rigid body, and accelerations do not enter.
#include <gtest/gtest.h>

#include "core/contact/surface_pair.h"
#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation2_4, DependsOnPlacementsAndLinearlyOnTwists) {
  const PlacedSurface one{Ellipsoid({0.7, 0.3, 0.5}), {0.1, 0, 0.2}, Rotation({0.3, 0.8, -0.4})};
  const PlacedSurface two{Ellipsoid({0.4, 0.6, 0.9}), {0, 0.1, 0}, Rotation({-0.2, 0.5, 0.9})};
  const auto g = [&](const Vector6& t_1, const Vector6& t_2, const Vector3& accelerations) -> Vector3 {
    FrameMotion body_1{
        Rotation({0.1, 0.2, 0.3}), {0, 0, 0}, t_1.head<3>(), t_1.tail<3>(), accelerations, accelerations};
    FrameMotion body_2{
        Rotation({0.9, -0.2, 0.4}), {2, 1, 1}, t_2.head<3>(), t_2.tail<3>(), accelerations, accelerations};
    return SurfacePair(one, two).Compute(body_1, body_2).slip;
  };
  Vector6 a, b;
  a << 0.3, -0.7, 0.2, 1.1, 0.4, -0.6;
  b << -0.5, 0.1, 0.8, 0.2, -0.9, 0.3;
  const Vector3 none = Vector3::Zero();
  const Vector3 value = g(a, b, none);
  EXPECT_GT(value.norm(), 0.1);
  EXPECT_EQ(g(a, b, Vector3(3, 1, 2)), value);
  EXPECT_TRUE(MatrixNear(g(a, Vector6::Zero(), none) + g(Vector6::Zero(), b, none), value, 1e-14));
  EXPECT_TRUE(MatrixNear(g(-2 * a, -2 * b, none), -2 * value, 1e-14));
  // Both turn about the world's origin as one body; the frames are at (0, 0, 0) and (2, 1, 1). The contact points are a
  // gap apart, so what is left is ω times the gap.
  Vector6 both_1, both_2;
  const Vector3 omega(0.3, -0.7, 0.2), shift(1, 2, 3);
  both_1 << omega, shift;
  both_2 << omega, shift + omega.cross(Vector3(2, 1, 1));
  SurfacePair pair(one, two);
  const PairKinematics at = pair.Compute({Rotation({0.1, 0.2, 0.3}), {0, 0, 0}, none, none, none, none},
                                         {Rotation({0.9, -0.2, 0.4}), {2, 1, 1}, none, none, none, none});
  EXPECT_TRUE(MatrixNear(g(both_1, both_2, none), at.gap * omega.cross(at.normal), 1e-13));
}

}  // namespace
}  // namespace rollgait
