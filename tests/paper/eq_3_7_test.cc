// Eq. (3.7): γ = J̇ᵗ q̇ + ω₁ × (v(C₁) + d(C₁P₁)/dt) − ω₂ × (v(C₂) + d(C₂P₂)/dt). On a fixed plane the last term is
// absent. Right if J̇ᵗ q̇ is the spatial acceleration at q̈ = 0 (linear part at the point P); the bracket is ṗ. With the
// classical acceleration of the material point the last term is ω × ẋ_rel only.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/contact_tree.h"
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

TEST(Equation3_7, TwoMovingBodies) {
  testing::ContactTree tree(5);
  ContactDynamics dynamics(BodyDynamics(tree.model), tree.contacts);
  dynamics.SetState(tree.q, tree.v, tree.ground);
  const PairKinematics pair = dynamics.Kinematics(3);
  // Contact points by the definition, and their rates by differences along q(t) with constant joint velocities.
  const auto points = [&](double t) {
    ContactDynamics moved(BodyDynamics(tree.model), tree.contacts);
    moved.SetState(Retract(tree.model, tree.q, t * tree.v), tree.v, tree.ground);
    const PairKinematics& at = moved.Kinematics(3);
    return (Vector6() << at.p_1, at.p_2).finished();
  };
  const Vector6 rates = Derivative(points);
  const auto term = [&](int link, const Vector3& p, const Vector3& p_dot) -> Vector3 {
    const BodyDynamics::Link& at = dynamics.state()[static_cast<size_t>(link)];
    const Vector3 omega = at.R_WL * at.twist.angular;
    const Vector3 spatial = at.R_WL * (at.bias.linear + at.bias.angular.cross(at.R_WL.transpose() * (p - at.p_WL)));
    return spatial + omega.cross(p_dot);
  };
  const Vector3 printed = term(tree.contacts[3].link, pair.p_1, rates.head<3>()) -
                          term(tree.contacts[3].other_link, pair.p_2, rates.tail<3>());
  EXPECT_TRUE(MatrixNear(printed, pair.drift, 100 * kDerivativeTolerance * (1 + pair.drift.norm())));
  EXPECT_GT(pair.drift.norm(), 0.1);
}

}  // namespace
}  // namespace rollgait
