// Eq. (3.7) on a fixed plane: γ = J̇ᵗ q̇ + ω × (v(C) + d(CP)/dt). Right if J̇ᵗ q̇ is the spatial acceleration at q̈ = 0 (linear part
// at the point P); the bracket is ṗ. With the classical acceleration of the material point the last term is ω × ẋ_rel only.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_7, DriftByBothKindsOfBias) {
  RollingTree tree;
  tree.a.setZero();
  const RollingContact contact = tree.ContactAt(0);
  const BodyDynamics::State state = tree.StateAt(0);
  const BodyDynamics::Link& link = state.back();
  const Vector3 omega = tree.Omega(), cp = contact.p_WP - tree.C();
  const Vector3 spatial = link.R_WL * (link.bias.linear + link.bias.angular.cross(link.R_WL.transpose() * cp));
  const Vector3 cp_rate = Derivative([&](double t) { return Vector3(tree.ContactAt(t).p_WP - tree.C(t)); });
  const Vector3 printed = spatial + omega.cross(tree.VelocityOfC() + cp_rate);
  EXPECT_TRUE(MatrixNear(printed, contact.drift, 10 * kDerivativeTolerance));

  const Vector3 classical = spatial + omega.cross(contact.slip);
  const Vector3 along_surface = contact.point_velocity - contact.slip;
  EXPECT_TRUE(MatrixNear(classical + omega.cross(along_surface), contact.drift, 1e-12));
  // The commonest error: the classical bias with the term that belongs to the spatial one.
  const Vector3 mixed = classical + omega.cross(contact.point_velocity);
  EXPECT_GT((mixed - contact.drift).norm(), 0.05 * contact.drift.norm());
  // Without the rolling term the point would be fixed in the body.
  EXPECT_GT((classical - contact.drift).norm(), 0.05 * contact.drift.norm());
}

}  // namespace
}  // namespace rollgait
