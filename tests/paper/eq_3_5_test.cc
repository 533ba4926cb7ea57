// Eq. (3.5): Jᵗ q̈ + γ = 0 is dw/dt = 0 for the velocity w = v(P) of (2.3); the superscript t means translational rows.
// Eq. (3.6): on a fixed plane Jᵗ has one block, ∂w/∂q̇.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_5, LeftSideIsTheRateOfTheSlip) {
  const RollingTree tree;
  const Vector3 rate = Derivative([&](double t) { return tree.ContactAt(t).slip; });
  const Vector3 value = tree.Jacobian() * tree.a + tree.ContactAt(0).drift;
  EXPECT_TRUE(MatrixNear(value, rate, 10 * kDerivativeTolerance));
  EXPECT_GT(tree.ContactAt(0).drift.norm(), 0.1);
}

TEST(Equation3_6, JacobianMapsJointVelocitiesToTheSlip) {
  const RollingTree tree;
  EXPECT_TRUE(MatrixNear(tree.Jacobian() * tree.v, tree.ContactAt(0).slip, 1e-13));
  EXPECT_GT(tree.ContactAt(0).slip.norm(), 0.1);
}

}  // namespace
}  // namespace rollgait
