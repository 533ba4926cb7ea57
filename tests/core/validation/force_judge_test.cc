#include "core/validation/force_judge.h"

#include <gtest/gtest.h>

#include <limits>

namespace rollgait {
namespace {

TEST(ForceExtremes, NormalForceAndFriction) {
  ForceExtremes forces(1000);
  EXPECT_EQ(forces.min_normal(), 0);
  EXPECT_EQ(forces.max_friction_ratio(), 0);
  forces.Add({30, 40, 500});
  EXPECT_EQ(forces.min_normal(), 500);
  EXPECT_NEAR(forces.max_friction_ratio(), 0.1, 1e-15);
  // Below a thousandth of the weight the floor of 1 N takes the place of the normal force.
  forces.Add({0.3, 0.4, 0.01});
  EXPECT_NEAR(forces.max_friction_ratio(), 0.5, 1e-15);
  forces.Add({2, 0, -3});
  EXPECT_EQ(forces.min_normal(), -3);
  EXPECT_NEAR(forces.max_friction_ratio(), 2, 1e-15);
  forces.Add({0, std::numeric_limits<double>::quiet_NaN(), 3});
  EXPECT_EQ(forces.min_normal(), -kInfinity);
  EXPECT_EQ(forces.max_friction_ratio(), kInfinity);
}

}  // namespace
}  // namespace rollgait
