// Eq. (3.4): dv(P)/dt = a_tP + ω × v(C) + ω × d(CP)/dt with the spatial a_tP = v̇_C + ω̇ × CP. It is v(C), not v(P); the
// last two terms together are ω × ṗ.
#include <gtest/gtest.h>

#include "tests/paper/rolling_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_4, RateOfTheMaterialVelocityAtTheContactPoint) {
  const RollingTree tree;
  const RollingContact contact = tree.ContactAt(0);
  const Vector3 rate = Derivative([&](double t) { return tree.ContactAt(t).slip; });
  const Vector3 omega = tree.Omega(), v_c = tree.VelocityOfC(), cp = contact.p_WP - tree.C();
  const Vector3 omega_rate = Derivative([&](double t) { return tree.Omega(t); });
  const Vector3 a_c = Derivative([&](double t) { return tree.VelocityOfC(t); });
  const Vector3 cp_rate = Derivative([&](double t) { return Vector3(tree.ContactAt(t).p_WP - tree.C(t)); });
  const Vector3 spatial = a_c - omega.cross(v_c) + omega_rate.cross(cp);
  const double tolerance = 10 * kDerivativeTolerance;  // several differences, times ω
  EXPECT_TRUE(MatrixNear(spatial + omega.cross(v_c) + omega.cross(cp_rate), rate, tolerance));
  EXPECT_TRUE(MatrixNear(spatial + omega.cross(contact.point_velocity), rate, tolerance));
  const Vector3 with_v_p = spatial + omega.cross(contact.slip) + omega.cross(cp_rate);
  EXPECT_GT((with_v_p - rate).norm(), 1e-2);  // m/s², a hundred thousand tolerances
}

}  // namespace
}  // namespace rollgait
