// Eq. (3.3): a(C) = v̇_C + ω × v(C), right for the spatial v̇_C; the derivative of the velocity in world axes is a(C)
// already.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_3, ClassicalAccelerationFromTheSpatialOne) {
  RollingTree tree;
  tree.a.setZero();  // so that the bias is the whole spatial acceleration
  const BodyDynamics::State state = tree.StateAt(0);
  const BodyDynamics::Link& link = state.back();
  const Vector3 spatial = link.R_WL * link.bias.linear;
  const Vector3 classical = Derivative([&](double t) { return tree.VelocityOfC(t); });
  EXPECT_TRUE(MatrixNear(spatial + tree.Omega().cross(tree.VelocityOfC()), classical, kDerivativeTolerance));
  EXPECT_GT((spatial - classical).norm(), 0.05 * classical.norm());
}

}  // namespace
}  // namespace rollgait
