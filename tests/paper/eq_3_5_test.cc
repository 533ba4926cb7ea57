// Eq. (3.5): Jᵗ q̈ + γ = 0 is dw/dt = 0 for the velocity w = v(P) of (2.3); the superscript t means translational rows.
// Eq. (3.6): Jᵗ = [Jᵗ₁  −Jᵗ₂]; on a fixed plane the second block is absent.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/contact_tree.h"
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

// A surface of one free body on a surface of another: the blocks are the Jacobians of the two material points.
TEST(Equation3_6, TwoBodiesHaveTwoBlocksOfOppositeSign) {
  testing::ContactTree tree(5);
  ContactDynamics dynamics(BodyDynamics(tree.model), tree.contacts);
  dynamics.SetState(tree.q, tree.v, tree.ground);
  const PairKinematics pair = dynamics.Kinematics(3);
  MatrixX linear, angular;
  dynamics.SlipJacobian(3, &linear, &angular);
  EXPECT_TRUE(MatrixNear(linear * tree.v, pair.slip, 1e-12));
  // Velocity of the point of a link that is now at p, by the law of (2.2) from the link's own twist.
  const auto velocity = [&](int link, const Vector3& p) -> Vector3 {
    const BodyDynamics::Link& at = dynamics.state()[static_cast<size_t>(link)];
    return at.R_WL * at.twist.linear + Vector3(at.R_WL * at.twist.angular).cross(p - at.p_WL);
  };
  VectorX only_1 = tree.v, only_2 = tree.v;
  // The body of contact 3 is the last link, with the last six velocities; the other one is the first.
  only_1.head(tree.model.nv() - 6).setZero();
  only_2.tail<6>().setZero();
  EXPECT_TRUE(MatrixNear(linear * only_1, velocity(tree.contacts[3].link, pair.p_1), 1e-12));
  EXPECT_TRUE(MatrixNear(linear * only_2, -velocity(tree.contacts[3].other_link, pair.p_2), 1e-12));
  EXPECT_GT((linear * only_2).norm(), 0.1);
}

}  // namespace
}  // namespace rollgait
