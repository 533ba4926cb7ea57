// Contacts that only push: they let go when they would have to pull, and what rests stays at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "core/simulation/simulation.h"
#include "tests/support/recorded_simulation.h"
#include "tests/support/rolling_scenes.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using testing::Record, testing::RecordedSimulation;

// m, ten times the tolerance of the integrator: samples between its steps are not put back on the ground.
constexpr double kLeastGap = -1e-8;

// A triaxial ellipsoid that rolls so fast that it leaves the ground, falls back and goes on.
SimulationScene SpinningEllipsoid(unsigned seed, double fastest) {
  SeededRandom random(seed);
  BodyOnPlane body;
  const Vector3 axes = random.Vector(0.05, 0.3);
  body.surface = Ellipsoid(axes);
  const Vector3 squares = axes.cwiseAbs2();
  body.inertia = Vector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()).asDiagonal();
  body.inertia /= 5;
  body.center_of_mass = random.Vector(-0.02, 0.02);
  // Draws in one order for every compiler.
  const Vector3 axis = random.Unit();
  body.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(random.Uniform(0, 3), axis));
  const Vector3 direction = random.Unit();
  body.omega_body = random.Uniform(0.1, 1) * fastest * direction;
  SimulationScene scene = SceneOf(body);
  scene.options.duration = 1;
  scene.options.output_step = 0.005;
  return scene;
}

// Neither a pull nor a fall through the ground, at any sample; nor a rolling that both would contradict, which a limit
// of friction has.
TEST(OneWay, BodiesThatLeaveTheGroundAreNotHeld) {
  int left = 0, impossible = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const double fastest = seed % 10 == 0 ? 1000 : 30;
    const RecordedSimulation outcome = Record(SpinningEllipsoid(seed, fastest));
    const double largest = 9.81 + 0.3 * fastest * fastest;  // N, about
    EXPECT_GE(outcome.report.min_normal_force, -1e-10 * largest) << seed;
    for (const SimulationSample& sample : outcome.samples) EXPECT_GE(sample.contacts[0].gap, kLeastGap) << seed;
    left += std::any_of(outcome.events.begin(), outcome.events.end(),
                        [](const SimulationEvent& event) { return event.kind == SimulationEventKind::kLiftOff; });
    const bool no_way = outcome.report.end == SimulationEnd::kRollingImpossible;
    impossible += no_way;
    EXPECT_TRUE(no_way || outcome.report.end == SimulationEnd::kDuration) << seed;
  }
  EXPECT_GE(left, 50);
  EXPECT_GE(impossible, 20);
}

// The same bodies with Coulomb friction slide before they would have to pull, and have a way on.
// The address sanitizer slows them twentyfold, and sees what it sees in the first ones.
#ifdef ROLLGAIT_ADDRESS_SANITIZER
constexpr unsigned kScenes = 20;
#else
constexpr unsigned kScenes = 100;
#endif

TEST(OneWay, ALimitOfFrictionLeavesAWayOn) {
  unsigned ended = 0;
  for (unsigned seed = 1; seed <= kScenes; ++seed) {
    SimulationScene scene = SpinningEllipsoid(seed, 30);
    scene.contacts[0].friction = 0.5;
    scene.contacts[0].friction_loss = FrictionLoss::kSlide;
    const RecordedSimulation outcome = Record(scene);
    EXPECT_GE(outcome.report.min_normal_force, -1e-7) << seed;
    for (const SimulationSample& sample : outcome.samples) EXPECT_GE(sample.contacts[0].gap, kLeastGap) << seed;
    EXPECT_NE(outcome.report.end, SimulationEnd::kRollingImpossible) << seed;
    ended += outcome.report.end == SimulationEnd::kDuration;
  }
  EXPECT_GE(10 * ended, 9 * kScenes);
}

// A plate on a grid of feet, turned by `tilt` (rad) and dropped.
SimulationScene DroppedPlate(int rows, int columns, double tilt) {
  Joint joint;
  joint.name = joint.link = "plate";
  joint.type = JointType::kFree;
  joint.mass = 3;
  joint.inertia = Vector3(0.3, 0.3, 0.55).asDiagonal();
  SimulationScene scene{"plate", Model::Create({joint}).value(), {}, {}, {}, {}, {}, {}, {}, -1, {}};
  scene.efforts = {0};
  scene.ground = {GroundMotion{}};
  scene.gravity = {0, 0, -9.81};
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      SceneContact foot;
      foot.contact.name = "foot" + std::to_string(scene.contacts.size());
      foot.contact.surface.surface = Sphere(0.03);
      foot.contact.surface.p_BE = Vector3(i / (rows - 1.0) - 0.5, j / (columns - 1.0) - 0.5, -0.05);
      foot.contact.ground = 0;
      scene.contacts.push_back(foot);
    }
  }
  const Eigen::Quaterniond q(Eigen::AngleAxisd(tilt, Vector3(0.6, 0.8, 0)));
  scene.q.resize(7);
  scene.q << q.w(), q.x(), q.y(), q.z(), 0, 0, 0.4;
  scene.v = VectorX::Zero(6);
  scene.options.duration = 2;
  return scene;
}

// However many feet: it comes to rest flat on the ground, and feet that touch share its weight, after a number of
// impacts that the plate decides and not rounding.
class FeetTest : public ::testing::TestWithParam<std::tuple<int, int, double>> {};

TEST_P(FeetTest, APlateComesToRest) {
  const auto [rows, columns, tilt] = GetParam();
  const RecordedSimulation outcome = Record(DroppedPlate(rows, columns, tilt));
  EXPECT_EQ(outcome.report.end, SimulationEnd::kDuration);
  EXPECT_GE(outcome.report.active_at_end.size(), 3u);
  EXPECT_LE(outcome.events.size(), 200u);
  EXPECT_GE(outcome.report.min_normal_force, -1e-9);
  EXPECT_LE(outcome.report.v.norm(), 1e-9);
  double weight = 0;
  for (const ContactSample& contact : outcome.samples.back().contacts) {
    EXPECT_GE(contact.force.z(), -1e-9);
    EXPECT_LE(std::abs(contact.gap), 1e-9);
    weight += contact.force.z();
  }
  EXPECT_NEAR(weight, 3 * 9.81, 1e-9);
  for (const SimulationSample& sample : outcome.samples) {
    for (const ContactSample& contact : sample.contacts) EXPECT_GE(contact.gap, kLeastGap);
  }
}

INSTANTIATE_TEST_SUITE_P(Plates, FeetTest,
                         ::testing::Combine(::testing::Values(2, 3, 4), ::testing::Values(2, 4),
                                            ::testing::Values(0.0, 1e-12, 1e-3, 0.02, 0.3)));

// A contact that touches and is not among the active ones carries what rests on it.
TEST(OneWay, WhatTouchesAtTheStartIsCarried) {
  SimulationScene scene = DroppedPlate(2, 2, 0);
  scene.q[6] = 0.08;
  const RecordedSimulation outcome = Record(scene);
  EXPECT_EQ(outcome.report.active_at_end.size(), 4u);
  EXPECT_EQ(outcome.report.impacts, 0);
  EXPECT_NEAR(outcome.report.q[6], 0.08, 1e-12);
}

}  // namespace
}  // namespace rollgait
