#include "core/models/rigid_body.h"

#include <gtest/gtest.h>

#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// Mass properties of point masses, summed one by one.
RigidBody FromPoints(const std::vector<double>& masses, const std::vector<Vector3>& points) {
  RigidBody body;
  for (size_t i = 0; i < points.size(); ++i) {
    body.mass += masses[i];
    body.center_of_mass += masses[i] * points[i];
  }
  body.center_of_mass /= body.mass;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3 p = points[i] - body.center_of_mass;
    body.inertia += masses[i] * (p.dot(p) * Matrix3::Identity() - p * p.transpose());
  }
  return body;
}

TEST(RigidBodyTest, LumpingBodiesEqualsSummingTheirPoints) {
  SeededRandom random(5);
  std::vector<RigidBody> bodies;
  std::vector<double> all_masses;
  std::vector<Vector3> all_points;
  for (int body = 0; body < 3; ++body) {
    const Vector3 origin = random.Vector(-1, 1);
    std::vector<double> masses;
    std::vector<Vector3> points;
    for (int i = 0; i < 6; ++i) {
      masses.push_back(random.Uniform(0.1, 2));
      points.push_back(random.Vector(-0.3, 0.3));
      all_masses.push_back(masses.back());
      all_points.push_back(points.back() + origin);
    }
    bodies.push_back(Shifted(FromPoints(masses, points), origin));
  }
  const RigidBody lumped = Lumped(bodies), expected = FromPoints(all_masses, all_points);
  // Rounding of some twenty additions of numbers of order ten.
  EXPECT_NEAR(lumped.mass, expected.mass, 1e-13);
  EXPECT_TRUE(MatrixNear(lumped.center_of_mass, expected.center_of_mass, 1e-14));
  EXPECT_TRUE(MatrixNear(lumped.inertia, expected.inertia, 1e-13));
  EXPECT_GT(lumped.inertia.trace(), 1);
}

TEST(RigidBodyTest, ShiftingKeepsMassAndCentralInertia) {
  const RigidBody body = FromPoints({1, 2}, {{0, 0, 0.1}, {0.2, 0, 0}});
  const RigidBody shifted = Shifted(body, {1, 2, 3});
  EXPECT_EQ(shifted.mass, body.mass);
  EXPECT_EQ(shifted.inertia, body.inertia);
  EXPECT_EQ(shifted.center_of_mass, Vector3(body.center_of_mass + Vector3(1, 2, 3)));
}

}  // namespace
}  // namespace rollgait
