// Eq. (3.2): â = J q̈ + J̇ q̇, and (3.1) its parts (ω̇, v̇). Here six-vectors are [angular; linear], always; the paper's
// text stacks velocities the other way round. J̇ q̇ is the spatial acceleration at q̈ = 0.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_2, SpatialAccelerationIsTheRateOfTheTwistInLinkAxes) {
  const RollingTree tree;
  // In link axes the components of the twist of the link frame have the spatial acceleration as derivative.
  const Vector6 rate = Derivative([&](double t) {
    const BodyDynamics::State state = tree.StateAt(t);
    return (Vector6() << state.back().twist.angular, state.back().twist.linear).finished();
  });
  const BodyDynamics::State state = tree.StateAt(0);
  const BodyDynamics::Motion& bias = state.back().bias;
  // J q̈ by linearity of the twist in the velocities.
  BodyDynamics::State with_a;
  tree.dynamics.ComputeState(tree.q, tree.a, &with_a);
  EXPECT_TRUE(MatrixNear(with_a.back().twist.angular + bias.angular, rate.head<3>(), kDerivativeTolerance));
  EXPECT_TRUE(MatrixNear(with_a.back().twist.linear + bias.linear, rate.tail<3>(), kDerivativeTolerance));
  EXPECT_GT(bias.linear.norm(), 0.1);
}

// The first three components are the rate of the angular velocity, in any axes; the last three are that of the
// components of v(C) in link axes, which is not the acceleration of C.
TEST(Equation3_1, AngularFirstThenLinear) {
  RollingTree tree;
  tree.a.setZero();
  const BodyDynamics::Link link = tree.StateAt(0).back();
  const Vector3 omega_rate = Derivative([&](double t) { return tree.Omega(t); });
  EXPECT_TRUE(MatrixNear(link.R_WL * link.bias.angular, omega_rate, kDerivativeTolerance));
  const Vector3 component_rate =
      Derivative([&](double t) { return Vector3(tree.StateAt(t).back().R_WL.transpose() * tree.VelocityOfC(t)); });
  EXPECT_TRUE(MatrixNear(link.bias.linear, component_rate, kDerivativeTolerance));
  const Vector3 acceleration = Derivative([&](double t) { return tree.VelocityOfC(t); });
  EXPECT_GT((link.R_WL * link.bias.linear - acceleration).norm(), 0.1);
}

}  // namespace
}  // namespace rollgait
