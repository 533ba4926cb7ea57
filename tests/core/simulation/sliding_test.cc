// Coulomb sliding, its end and its beginning, against closed forms and against an integration of the particle
// equations.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/simulation/simulation.h"
#include "tests/support/matrix_near.h"
#include "tests/support/recorded_simulation.h"
#include "tests/support/sliding_ball.h"

namespace rollgait {
namespace {

using testing::kG, testing::kMass, testing::kRadius, testing::Record, testing::RecordedSimulation;

Vector3 WorldVelocity(const SimulationReport& report) {
  const Eigen::Quaterniond rotation(report.q[0], report.q[1], report.q[2], report.q[3]);
  return rotation * Vector3(report.v.tail<3>());
}

TEST(Sliding, BallBowledOnTheFlatBeginsToRoll) {
  const double mu = 0.23, v0 = 3.1, begin = 2 * v0 / (7 * mu * kG);
  SimulationScene scene = testing::Ball(mu, {0, 0, -kG}, {v0, 0, 0}, Vector3::Zero());
  scene.options.duration = 2 * begin;
  scene.options.output_step = begin / 7;
  const RecordedSimulation outcome = Record(scene);
  ASSERT_EQ(outcome.events.size(), 1u);
  EXPECT_EQ(outcome.events[0].kind, SimulationEventKind::kStick);
  EXPECT_NEAR(outcome.events[0].time, begin, 1e-9);
  EXPECT_TRUE(MatrixNear(WorldVelocity(outcome.report), Vector3(5.0 / 7 * v0, 0, 0), 1e-9));
  EXPECT_NEAR(outcome.report.q[4], 12.0 / 49 * v0 * v0 / (mu * kG) + 5.0 / 7 * v0 * begin, 1e-9);
  // Friction took 2/7 of the energy, and the balance of the report includes it.
  EXPECT_NEAR(outcome.report.energy_final - outcome.report.energy_initial, -2.0 / 7 * 0.5 * kMass * v0 * v0, 1e-8);
  EXPECT_NEAR(outcome.samples.back().work, -2.0 / 7 * 0.5 * kMass * v0 * v0, 1e-8);
  EXPECT_LT(outcome.report.max_energy_error, 1e-9);
  EXPECT_NEAR(outcome.report.max_friction_ratio, mu, 1e-12);
  for (const SimulationSample& sample : outcome.samples) {
    EXPECT_EQ(sample.contacts[0].sliding, sample.time < begin);
    EXPECT_NEAR(sample.contacts[0].force.x(), sample.time < begin ? -mu * kMass * kG : 0, 1e-9);
  }
}

// Bowled up an incline: sliding down to rolling at v0 / (g sin + 7/2 μ g cos), then 5/7 g sin.
TEST(Sliding, BallBowledUpAnIncline) {
  const double mu = 0.31, slope = 0.4, v0 = 2.4;
  const double along = kG * std::sin(slope), normal = kG * std::cos(slope);
  const double begin = v0 / (along + 3.5 * mu * normal);
  SimulationScene scene = testing::Ball(mu, {-along, 0, -normal}, {v0, 0, 0}, Vector3::Zero());
  scene.options.duration = 1;
  const RecordedSimulation outcome = Record(scene);
  ASSERT_EQ(outcome.events.size(), 1u);
  EXPECT_NEAR(outcome.events[0].time, begin, 1e-9);
  const double rolling = v0 - (along + mu * normal) * begin;
  EXPECT_NEAR(WorldVelocity(outcome.report).x(), rolling - 5.0 / 7 * along * (1 - begin), 1e-9);
}

// On a slope of tan > 7/2 μ it slides from the start and for ever.
TEST(Sliding, SteepSlopeNeverLetsItRoll) {
  const double mu = 0.1, slope = 0.6, along = kG * std::sin(slope), normal = kG * std::cos(slope);
  const RecordedSimulation outcome = Record(testing::Ball(mu, {along, 0, -normal}, Vector3::Zero(), Vector3::Zero()));
  ASSERT_EQ(outcome.events.size(), 1u);
  EXPECT_EQ(outcome.events[0].kind, SimulationEventKind::kFrictionLoss);
  EXPECT_EQ(outcome.events[0].time, 0);
  EXPECT_NEAR(WorldVelocity(outcome.report).x(), along - mu * normal, 1e-9);
  EXPECT_NEAR(outcome.report.v[1] * kRadius, 2.5 * mu * normal, 1e-9);
}

// With side spin on an incline the slip turns: ẇ = g_t − 7/2 μ g_n w/|w|, integrated here with small steps of order 4.
TEST(Sliding, SlipThatTurns) {
  const double mu = 0.2, slope = 0.3, along = kG * std::sin(slope), normal = kG * std::cos(slope);
  const Vector3 v0(0.4, 1.6, 0), omega0(-3, 6, 2);
  SimulationScene scene = testing::Ball(mu, {along, 0, -normal}, v0, omega0);
  const auto slope_of = [&](const Eigen::Vector2d& w) {
    return Eigen::Vector2d(Eigen::Vector2d(along, 0) - 3.5 * mu * normal * w.normalized());
  };
  const Vector3 slip = v0 + omega0.cross(Vector3(0, 0, -kRadius));
  Eigen::Vector2d w = slip.head<2>();
  const double h = 1e-5, end = 0.1;
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector2d a = slope_of(w), b = slope_of(w + 0.5 * h * a), c = slope_of(w + 0.5 * h * b);
    w += h / 6 * (a + 2 * b + 2 * c + slope_of(w + h * c));
  }
  scene.options.duration = end;
  const RecordedSimulation outcome = Record(scene);
  EXPECT_TRUE(outcome.events.empty());
  const Vector3 found = outcome.samples.back().contacts[0].slip;
  // kSlidingBlend times the turn within a step over |w|.
  EXPECT_TRUE(MatrixNear(found.head<2>(), w, 1e-7));
  // Later it rolls: tan < 7/2 μ.
  scene.options.duration = 3;
  const RecordedSimulation later = Record(scene);
  ASSERT_EQ(later.events.size(), 1u);
  EXPECT_EQ(later.events[0].kind, SimulationEventKind::kStick);
  EXPECT_LT(later.samples.back().contacts[0].slip.norm(), 1e-9);
  EXPECT_LT(later.report.max_energy_error, 1e-8);
}

// A box on four feet: rows that depend on each other. It slides to rest and stays.
TEST(Sliding, BoxOnFourFeetStops) {
  const double mu = 0.4, v0 = 1.7, stop = v0 / (mu * kG);
  SimulationScene scene = testing::Ball(mu, {0, 0, -kG}, {v0, 0, 0}, Vector3::Zero());
  scene.contacts.resize(4, scene.contacts[0]);
  for (int k = 0; k < 4; ++k) {
    PlacedSurface& foot = scene.contacts[static_cast<size_t>(k)].contact.surface;
    foot = {Sphere(0.02), Vector3(k % 2 == 0 ? 0.3 : -0.3, k < 2 ? 0.2 : -0.2, 0.02 - kRadius), Matrix3::Identity()};
  }
  scene.options.duration = 2 * stop;
  const RecordedSimulation outcome = Record(scene);
  EXPECT_EQ(outcome.report.end, SimulationEnd::kDuration);
  ASSERT_FALSE(outcome.events.empty());
  EXPECT_NEAR(outcome.events[0].time, stop, 1e-9);
  EXPECT_NEAR(outcome.report.q[4], 0.5 * v0 * stop, 1e-9);
  EXPECT_LT(outcome.report.v.norm(), 1e-9);
  EXPECT_TRUE(outcome.report.redundant);
}

// A block on a plane that is shaken along: it sticks where the plane's acceleration is below μ g and slides where not.
// Along one line the motion is a sequence of parabolas relative to the world; here it is stepped through in closed
// form.
TEST(Sliding, BlockOnAShakenPlaneSticksAndSlips) {
  std::vector<Joint> joints(2);
  joints[0].name = "x", joints[0].type = JointType::kPrismatic, joints[0].axis = Vector3::UnitX();
  joints[1].name = "z", joints[1].type = JointType::kPrismatic, joints[1].axis = Vector3::UnitZ();
  joints[1].parent = 0, joints[1].mass = kMass, joints[1].inertia = Matrix3::Identity();
  const double mu = 0.3, amplitude = 0.1, frequency = 1.3, rate = 2 * M_PI * frequency;
  SimulationScene scene = testing::Ball(mu, {0, 0, -kG}, Vector3::Zero(), Vector3::Zero());
  scene.model = Model::Create(joints).value();
  scene.efforts.resize(2);
  scene.q = Eigen::Vector2d(0, kRadius);
  scene.contacts[0].contact.link = 1;
  scene.contacts[0].contact.grip = Grip::kRollingAlong;
  scene.contacts[0].contact.ground = 1;
  scene.ground.resize(2);
  scene.ground[1].amplitude = Vector3(amplitude, 0, 0);
  scene.ground[1].frequency = frequency;
  scene.ground[1].phase = M_PI / 2;  // at rest at t = 0, in its outermost place: acceleration −A rate²
  scene.v = VectorX::Zero(2);
  scene.options.duration = 4;
  const RecordedSimulation outcome = Record(scene);
  EXPECT_EQ(outcome.report.end, SimulationEnd::kDuration);
  EXPECT_LT(outcome.report.max_energy_error, 1e-9);
  // Slides from t = 0 at −μ g until the plane, v = −A rate sin(rate t), is as slow.
  const auto difference = [&](double t) { return -mu * kG * t + amplitude * rate * std::sin(rate * t); };
  double low = 0.1, high = 0.6;
  ASSERT_GT(difference(low), 0);
  ASSERT_LT(difference(high), 0);
  for (int i = 0; i < 100; ++i) (difference(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  ASSERT_GT(outcome.events.size(), 4u);
  EXPECT_EQ(outcome.events[0].kind, SimulationEventKind::kFrictionLoss);
  EXPECT_EQ(outcome.events[1].kind, SimulationEventKind::kStick);
  EXPECT_NEAR(outcome.events[1].time, low, 1e-9);
  for (const SimulationSample& sample : outcome.samples) {
    EXPECT_LE(std::abs(sample.acceleration[0]), mu * kG * (1 + 1e-9));
  }
}

// A rod that leans forward, pushed along: with enough friction pressing harder accelerates its tip into the ground
// (Painlevé).
TEST(Sliding, JammingIsRefused) {
  Joint joint;
  joint.name = "rod", joint.type = JointType::kFree, joint.mass = 1;
  joint.inertia = Vector3(1.0 / 3, 1.0 / 3, 1e-3).asDiagonal();
  SimulationScene scene = testing::Ball(3, {0, 0, -kG}, {-1, 0, 0}, Vector3::Zero());
  scene.model = Model::Create({joint}).value();
  scene.contacts[0].contact.surface = {Sphere(1e-3), Vector3(0, 0, -1), Matrix3::Identity()};
  const double lean = 0.7;
  scene.q << std::cos(lean / 2), 0, std::sin(lean / 2), 0, 0, 0, std::cos(lean) + 1e-3;
  const Eigen::Quaterniond rotation(scene.q[0], scene.q[1], scene.q[2], scene.q[3]);
  scene.v.tail<3>() = rotation.inverse() * Vector3(-1, 0, 0);
  EXPECT_EQ(Record(scene).report.end, SimulationEnd::kFrictionUndetermined);
  scene.contacts[0].friction = 0.3;
  EXPECT_NE(Record(scene).report.end, SimulationEnd::kFrictionUndetermined);
}

// Lands at an angle: with much friction the impact sticks, with little it slides on with an impulse on the cone.
TEST(Sliding, ImpactsKeepTheirSlipBeyondTheCone) {
  for (const double mu : {2.0, 0.1}) {
    SimulationScene scene = testing::Ball(mu, {0, 0, -kG}, {2, 0, -1}, Vector3::Zero());
    scene.contacts[0].active = false;
    scene.q[6] = kRadius + 0.2;
    scene.options.duration = 0.2;
    const RecordedSimulation outcome = Record(scene);
    ASSERT_FALSE(outcome.events.empty());
    const SimulationEvent& impact = outcome.events[0];
    ASSERT_EQ(impact.kind, SimulationEventKind::kTouchDown);
    const double down = std::sqrt(1 + 2 * kG * 0.2), needed = 2.0 / 7 * 2 / down;
    EXPECT_NEAR(-impact.impulses[0].x() / impact.impulses[0].z(), std::min(mu, needed), 1e-9);
    EXPECT_LT(outcome.report.max_energy_error, 1e-9);
  }
}

TEST(Sliding, RefusesWhatHasNoMeaning) {
  SimulationScene scene = testing::Ball(0.3, {0, 0, -kG}, Vector3::Zero(), Vector3::Zero());
  SceneContact& contact = scene.contacts[0];
  const auto refused = [&] {
    const Violations violations = CheckScene(scene);
    return violations.empty() ? std::string() : violations[0].field + " " + violations[0].message;
  };
  contact.friction = kInfinity;
  EXPECT_EQ(refused(), "contacts[0].friction_loss is FRICTION_LOSS_SLIDE; needs a finite coefficient `friction`");
  for (const double friction : {-0.1, std::nan(""), 0.0}) {
    contact.friction = friction;
    EXPECT_EQ(refused().find("contacts[0].friction is "), 0u) << refused();
  }
  contact.friction = 0.3;
  contact.contact.no_spin = true;
  EXPECT_NE(refused().find("no_spin"), std::string::npos);
  contact.contact.no_spin = false;
  contact.contact.grip = Grip::kFrictionless;
  EXPECT_NE(refused().find("GRIP_FRICTIONLESS"), std::string::npos);
}

}  // namespace
}  // namespace rollgait
