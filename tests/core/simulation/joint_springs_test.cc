// Springs, dampers and constant efforts of joints in simulations: against closed forms, and in the balance of energy.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/recorded_simulation.h"

namespace rollgait {
namespace {

using testing::Record;
using testing::RecordedSimulation;

constexpr double kOscillating = 2, kSpring = 50, kSpringRest = 0.3, kDamper = 1.5, kPush = 4;

// A mass on a line, without gravity.
SimulationScene Oscillator() {
  Joint joint;
  joint.name = "x";
  joint.type = JointType::kPrismatic;
  joint.axis = Vector3::UnitX();
  joint.mass = kOscillating;
  joint.stiffness = kSpring;
  joint.rest_position = kSpringRest;
  joint.damping = kDamper;
  SimulationScene scene{
      "oscillator", Model::Create({joint}).value(), {kPush}, {GroundMotion{}}, {}, {}, {}, {}, {}, -1, {}};
  scene.gravity.setZero();
  scene.q = VectorX::Constant(1, 1);
  scene.v = VectorX::Constant(1, -2);
  scene.options.duration = 2;
  return scene;
}

TEST(JointSprings, MassOscillatesInClosedForm) {
  const SimulationScene scene = Oscillator();
  const RecordedSimulation recorded = Record(scene);
  const double middle = kSpringRest + kPush / kSpring, decay = kDamper / (2 * kOscillating);
  const double rate = std::sqrt(kSpring / kOscillating - decay * decay);
  const double cosine = scene.q[0] - middle, sine = (scene.v[0] + decay * cosine) / rate;
  const auto energy = [](double x, double v) {
    return 0.5 * kOscillating * v * v + 0.5 * kSpring * (x - kSpringRest) * (x - kSpringRest);
  };
  ASSERT_GT(recorded.samples.size(), 100u);
  for (const SimulationSample& sample : recorded.samples) {
    const double c = std::cos(rate * sample.time), s = std::sin(rate * sample.time), e = std::exp(-decay * sample.time);
    const double x = middle + e * (cosine * c + sine * s);
    const double v = e * ((rate * sine - decay * cosine) * c - (rate * cosine + decay * sine) * s);
    // The integrator's tolerance is 1e-9.
    EXPECT_NEAR(sample.q[0], x, 1e-8);
    EXPECT_NEAR(sample.v[0], v, 1e-7);
    EXPECT_NEAR(sample.kinetic_energy + sample.potential_energy, energy(x, v), 1e-6);
    EXPECT_NEAR(sample.work, energy(x, v) - energy(scene.q[0], scene.v[0]), 1e-6);
  }
  EXPECT_LT(recorded.report.max_energy_error, 1e-6);
  EXPECT_LT(recorded.samples.back().work, -5);
}

// A body that turns about an axis of its own against the damper of its free joint: its spin fades exponentially.
TEST(JointSprings, DamperOfAFreeJointStopsTheSpin) {
  const double inertia = 0.5;
  Joint joint;
  joint.name = "body";
  joint.type = JointType::kFree;
  joint.mass = kOscillating;
  joint.inertia = Vector3(0.4, 0.6, inertia).asDiagonal();
  joint.damping = kDamper;
  SimulationScene scene{"top", Model::Create({joint}).value(), {0.0}, {GroundMotion{}}, {}, {}, {}, {}, {}, -1, {}};
  scene.gravity.setZero();
  scene.q = VectorX::Unit(7, 0);
  scene.v = VectorX::Zero(6);
  scene.v[2] = 3;
  const RecordedSimulation recorded = Record(scene);
  for (const SimulationSample& sample : recorded.samples) {
    EXPECT_NEAR(sample.v[2], 3 * std::exp(-kDamper / inertia * sample.time), 1e-8);
  }
  EXPECT_LT(recorded.report.max_energy_error, 1e-6);
  EXPECT_LT(recorded.samples.back().v[2], 0.2);
}

}  // namespace
}  // namespace rollgait
