// A nut on a vertical screw without friction, in closed form: its weight turns it, τ − m g p = (I + m p²) q̈.
#include <gtest/gtest.h>

#include "tests/support/recorded_simulation.h"

namespace rollgait {
namespace {

constexpr double kMass = 0.5, kInertia = 2e-4, kPitch = 0.02, kGravity = 9.81, kEffort = 0.03, kSpeed = 7;

SimulationScene Nut() {
  Joint joint;
  joint.name = "nut";
  joint.type = JointType::kScrew;
  joint.pitch = kPitch;
  joint.mass = kMass;
  joint.center_of_mass = Vector3(0, 0, 0.01);
  joint.inertia = Vector3(kInertia, kInertia, kInertia).asDiagonal();
  SimulationScene scene{"nut", Model::Create({joint}).value(), {kEffort}, {GroundMotion{}}, {}, {}, {}, {}, {}, -1, {}};
  scene.gravity = Vector3(0, 0, -kGravity);
  scene.q = VectorX::Zero(1);
  scene.v = VectorX::Constant(1, kSpeed);
  scene.options.duration = 0.5;
  return scene;
}

TEST(Screw, ANutFallsInClosedForm) {
  const testing::RecordedSimulation recorded = testing::Record(Nut());
  const double a = (kEffort - kMass * kGravity * kPitch) / (kInertia + kMass * kPitch * kPitch);
  ASSERT_GT(recorded.samples.size(), 20u);
  const double start = recorded.samples.front().kinetic_energy + recorded.samples.front().potential_energy;
  EXPECT_NEAR(recorded.samples.front().kinetic_energy, 0.5 * (kInertia + kMass * kPitch * kPitch) * kSpeed * kSpeed,
              1e-15);
  for (const SimulationSample& sample : recorded.samples) {
    const double t = sample.time;
    // The integrator's tolerance is 1e-9.
    EXPECT_NEAR(sample.q[0], kSpeed * t + a * t * t / 2, 1e-8);
    EXPECT_NEAR(sample.v[0], kSpeed + a * t, 1e-8);
    EXPECT_NEAR(sample.kinetic_energy + sample.potential_energy - start, kEffort * sample.q[0], 1e-9);
  }
  EXPECT_LT(recorded.samples.back().q[0], -10);
}

}  // namespace
}  // namespace rollgait
