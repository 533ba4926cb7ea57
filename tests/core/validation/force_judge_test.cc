#include "core/validation/force_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/flywheel_ball.h"
#include "tests/support/seeded_random.h"

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

// Two or three contacts on the ball and one on the flywheel.
Scene ManyContacts(bool in_space) {
  Scene scene = FlywheelBall::MakeScene();
  for (const char* name : {"third", "wheel"}) {
    ContactSurface surface = scene.contacts[0];
    surface.name = name;
    scene.contacts.push_back(surface);
  }
  scene.contacts[3].joint = 3;
  for (ContactSurface& surface : scene.contacts) {
    if (in_space) surface.directions = {0, 1, 2};
  }
  return scene;
}

class SharedFriction : public ::testing::Test {
 protected:
  // Rows: force x y z, point x y.
  double Ratio(const std::vector<int>& contacts, const std::vector<double>& rows, bool in_space = true) {
    const Scene scene = ManyContacts(in_space);
    const ForceJudge judge(scene, contacts, {}, &extremes_);
    return judge.FrictionRatio(rows.data(), &worst_);
  }

  ForceExtremes extremes_{1000};  // floor: 1 N
  int worst_ = -1;
};

TEST_F(SharedFriction, AnInternalForceIsNoFriction) {
  // 20 N along x over 700 N, and 480 N that the two contacts push against each other.
  EXPECT_NEAR(Ratio({0, 1}, {500, 0, 300, 0.2, 0, -480, 0, 400, 0, 0}), 20.0 / 700, 1e-12);
  // The same on two links, which do move against each other.
  EXPECT_NEAR(Ratio({0, 3}, {500, 0, 300, 0.2, 0, -480, 0, 400, 0, 0}), 500.0 / 300, 1e-12);
  EXPECT_EQ(worst_, 0);
  // Across the line between the contacts nothing can be shifted.
  EXPECT_NEAR(Ratio({0, 1}, {0, 30, 300, 0.2, 0, 0, -80, 400, 0, 0}), 0.2, 1e-12);
  EXPECT_EQ(worst_, 1);
  // In the plane the line is along x, whatever the contacts are apart to the side.
  EXPECT_NEAR(Ratio({0, 1}, {500, 0, 300, 0.2, 0.1, -480, 0, 400, 0, 0}, false), 20.0 / 700, 1e-12);
}

// A contact that transmits no force along the line takes no share of another one's.
TEST_F(SharedFriction, AContactWithoutFrictionTakesNoShare) {
  Scene scene = ManyContacts(true);
  scene.contacts[1].directions = {2};
  const std::vector<double> rows = {150, 0, 300, 0.2, 0, 0, 0, 400, 0, 0};
  EXPECT_NEAR(ForceJudge(scene, {0, 1}, {}, &extremes_).FrictionRatio(rows.data(), &worst_), 0.5, 1e-12);
  EXPECT_NEAR(Ratio({0, 1}, rows), 150.0 / 700, 1e-12);
}

TEST_F(SharedFriction, BelowTheFloorTheFloorCounts) {
  // 4 N over 1 N (the floor, though the first pulls) and 3 N.
  EXPECT_NEAR(Ratio({0, 1}, {50, 0, -7, 0.2, 0, -46, 0, 3, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(Ratio({0}, {3, 4, 0.5, 0, 0}), 5, 1e-12);
  EXPECT_NEAR(Ratio({0}, {3, 4, -0.5, 0, 0}), 5, 1e-12);
}

TEST_F(SharedFriction, TwoContactsInSpaceAgreeWithASearch) {
  SeededRandom random(8);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> rows;
    for (int c = 0; c < 2; ++c) {
      for (double value : {random.Uniform(-300, 300), random.Uniform(-50, 50), random.Uniform(5, 500),
                           random.Uniform(-0.1, 0.1), random.Uniform(-0.1, 0.1)}) {
        rows.push_back(value);
      }
    }
    const Eigen::Vector2d d = Eigen::Vector2d(rows[3] - rows[8], rows[4] - rows[9]).normalized();
    double least = kInfinity;
    for (double s = -1000; s <= 1000; s += 0.05) {
      const double first = std::hypot(rows[0] + s * d.x(), rows[1] + s * d.y()) / rows[2];
      least = std::min(least, std::max(first, std::hypot(rows[5] - s * d.x(), rows[6] - s * d.y()) / rows[7]));
    }
    const double ratio = Ratio({0, 1}, rows);
    EXPECT_LE(ratio, least * (1 + 1e-9)) << trial;
    EXPECT_GT(ratio, least - 0.03 / std::min(rows[2], rows[7])) << trial;
  }
}

TEST_F(SharedFriction, ThreeContactsOnALineShareAll) {
  EXPECT_NEAR(Ratio({0, 1, 2}, {900, 0, 300, 0.2, 0, -700, 0, 200, 0.1, 0, -100, 0, 500, 0, 0}), 0.1, 1e-3);
  EXPECT_GE(Ratio({0, 1, 2}, {900, 0, 300, 0.2, 0, -700, 0, 200, 0.1, 0, -100, 0, 500, 0, 0}), 0.1 - 1e-12);
}

TEST_F(SharedFriction, NaNIsInfinite) {
  EXPECT_EQ(Ratio({0}, {0, std::numeric_limits<double>::quiet_NaN(), 5, 0, 0}), kInfinity);
  EXPECT_EQ(Ratio({0, 1}, {0, 0, 5, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 5, 0, 0}), kInfinity);
}

}  // namespace
}  // namespace rollgait
