// Two free bodies that roll on each other: nothing acts from outside, so momentum and energy are kept.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <tuple>

#include "core/multibody/body_dynamics.h"
#include "core/simulation/simulation.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

SimulationScene TwoBodies(bool plane, bool no_spin) {
  std::vector<Joint> joints(2);
  for (int i = 0; i < 2; ++i) {
    Joint& joint = joints[static_cast<size_t>(i)];
    joint.name = i == 0 ? "one" : "two";
    joint.type = JointType::kFree;
    joint.mass = 1 + i;
    joint.center_of_mass = Vector3(0.02, -0.01, 0.03);
    joint.inertia = Vector3(0.02, 0.03, 0.04).asDiagonal();
  }
  SimulationScene scene{"pair", Model::Create(joints).value(), {}, {}, {}, {}, {}, {}, {}, -1, {}};
  scene.efforts.resize(2);
  scene.ground = {GroundMotion{}};
  SceneContact contact;
  contact.contact.name = "touch";
  contact.contact.link = 0;
  contact.contact.surface.surface = Ellipsoid(Vector3(0.3, 0.2, 0.15));
  contact.contact.other_link = 1;
  if (plane) {
    contact.contact.other = PlacedPlane{Vector3(0, 0, 0.1), Vector3(0.1, 0.2, 1).normalized()};
  } else {
    contact.contact.other =
        PlacedSurface{Ellipsoid(Vector3(0.25, 0.35, 0.2)), Vector3(0.02, 0, 0.01), Matrix3::Identity()};
  }
  contact.contact.no_spin = no_spin;
  contact.active = contact.bilateral = true;
  scene.contacts = {contact};
  scene.gravity.setZero();
  scene.q.resize(14), scene.v.resize(12);
  scene.q << 0.9, 0.2, -0.3, 0.1, 0.05, 0.02, 0.45, 1, 0.1, 0.2, -0.1, 0, 0, 0;
  scene.v << 0.7, -0.4, 0.5, 0, 0, 0, 0.3, 0.6, -0.2, 0.1, 0.2, 0.05;
  if (no_spin) {
    // Both turn alike at the start, so there is no relative spin.
    const Eigen::Quaterniond one(scene.q[0], scene.q[1], scene.q[2], scene.q[3]);
    const Eigen::Quaterniond two(scene.q[7], scene.q[8], scene.q[9], scene.q[10]);
    scene.v.head<3>() = one.normalized().conjugate() * (two.normalized() * Vector3(scene.v.segment<3>(6)));
  }
  scene.adjusted_joints = {0};
  scene.options.duration = 2;
  scene.options.tolerance = 1e-11;
  scene.options.drift = DriftControl::kNone;
  return scene;
}

class PairRollingTest : public ::testing::TestWithParam<std::tuple<bool, bool>> {};

TEST_P(PairRollingTest, KeepsMomentumAndEnergy) {
  const SimulationScene scene = TwoBodies(std::get<0>(GetParam()), std::get<1>(GetParam()));
  ASSERT_TRUE(CheckScene(scene).empty());
  const BodyDynamics dynamics(scene.model);
  Vector3 momentum = Vector3::Zero();
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    BodyDynamics::State state;
    dynamics.ComputeState(sample.q, sample.v, &state);
    if (sample.time == 0) momentum = dynamics.LinearMomentum(state);
    EXPECT_TRUE(MatrixNear(dynamics.LinearMomentum(state), momentum, 1e-9)) << sample.time;
    return true;
  };
  const Result<SimulationReport> result = Simulate(scene, observer);
  ASSERT_TRUE(result.ok()) << result.violations()[0].message;
  const SimulationReport& report = result.value();
  EXPECT_EQ(report.end, SimulationEnd::kDuration);
  EXPECT_LT(report.max_energy_error, 1e-9);
  EXPECT_LT(report.max_gap, 1e-9);
  EXPECT_LT(report.max_slip, 1e-9);
  EXPECT_GT(report.energy_initial, 1e-3);
  EXPECT_FALSE(report.redundant);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PairRollingTest, ::testing::Combine(::testing::Bool(), ::testing::Bool()));

}  // namespace
}  // namespace rollgait
