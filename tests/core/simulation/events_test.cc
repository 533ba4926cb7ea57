// Events, impacts, drift control and refusals.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/simulation/simulation.h"
#include "tests/support/matrix_near.h"
#include "tests/support/passive_walker.h"
#include "tests/support/recorded_simulation.h"
#include "tests/support/rolling_scenes.h"

namespace rollgait {
namespace {

using testing::Record, testing::RecordedSimulation;

// A ball that rolls down on the outside of a fixed ball leaves it where cos θ = 10/17 (solid balls, no slip).
TEST(Events, ABallLeavesABallAtTenSeventeenths) {
  BodyOnPlane ball;
  ball.surface = Sphere(0.1);
  ball.inertia = 0.4 * 0.01 * Matrix3::Identity();
  SimulationScene scene = SceneOf(ball);
  TreeContact& contact = scene.contacts[0].contact;
  contact.other = PlacedSurface{Sphere(0.4), Vector3::Zero(), Matrix3::Identity()};
  contact.ground = 0;
  // On the top, started with a small speed: the energy below counts it.
  scene.q.tail<3>() = Vector3(0, 0, 0.5);
  const double start = 0.01;
  scene.v.head<3>() = Vector3(0, start / 0.1, 0);
  scene.options.duration = 3;
  scene.options.tolerance = 1e-11;
  const RecordedSimulation outcome = Record(scene);
  ASSERT_FALSE(outcome.events.empty());
  EXPECT_EQ(outcome.events[0].kind, SimulationEventKind::kLiftOff);
  const Vector3 p = outcome.events[0].q.tail<3>();
  // 7/10 v² = g R (1 − cos θ) + 7/10 v₀², and it leaves where v² = g R cos θ, with R = 0.5.
  const double expected = (10 + 7 * start * start / (9.81 * 0.5)) / 17;
  EXPECT_NEAR(p.z() / p.norm(), expected, 1e-9);
  EXPECT_NEAR(p.norm(), 0.5, 1e-12);
  EXPECT_LT(outcome.report.max_energy_error, 1e-8);
  EXPECT_TRUE(outcome.report.active_at_end.empty());
}

// A ball falls on the ground: the time of touch-down to rounding, one plastic impact, then it rests.
TEST(Events, ABallTouchesDownOnTimeAndStays) {
  BodyOnPlane ball;
  ball.surface = Sphere(0.1);
  ball.inertia = 0.4 * 0.01 * Matrix3::Identity();
  SimulationScene scene = SceneOf(ball);
  scene.contacts[0].active = false;
  scene.adjusted_joints.clear();
  scene.q.tail<3>() = Vector3(0, 0, 1.1);
  scene.v.tail<3>() = Vector3(2, 0, 0);
  scene.options.duration = 1;
  const RecordedSimulation outcome = Record(scene);
  ASSERT_EQ(outcome.events.size(), 1u);
  const SimulationEvent& event = outcome.events[0];
  EXPECT_EQ(event.kind, SimulationEventKind::kTouchDown);
  EXPECT_NEAR(event.time, std::sqrt(2 / 9.81), 1e-14);
  // Without slip: the forward speed falls to 5/7 of itself.
  EXPECT_NEAR(event.velocity_after[3], 10.0 / 7, 1e-12);
  EXPECT_NEAR(event.impulses[0].z(), std::sqrt(2 * 9.81), 1e-12);
  EXPECT_NEAR(event.energy_loss, 9.81 + 0.5 * 4 * (2.0 / 7), 1e-12);
  EXPECT_EQ(outcome.report.impacts, 1);
  EXPECT_EQ(outcome.report.active_at_end, std::vector<int>{0});
  EXPECT_LT(outcome.report.max_energy_error, 1e-8);
}

// The friction that a ball on a slope needs is 2/7 tan(slope): lost on a platform that tilts, when it passes the
// coefficient.
TEST(Events, FrictionIsLostWhereItIsNotEnough) {
  BodyOnPlane ball;
  ball.surface = Sphere(0.1);
  ball.inertia = 0.4 * 0.01 * Matrix3::Identity();
  ball.ground.axis = Vector3::UnitY();
  ball.ground.swing = 0.3;
  ball.ground.swing_frequency = 1e-3;  // slow: the slope is 0.3 sin(2π t/1000), nothing else moves the ball much
  SimulationScene scene = SceneOf(ball);
  scene.contacts[0].friction = 2.0 / 7 * std::tan(0.01);
  scene.options.duration = 10;
  scene.options.tolerance = 1e-10;
  RecordedSimulation outcome = Record(scene);
  ASSERT_EQ(outcome.events.size(), 1u);
  EXPECT_EQ(outcome.events[0].kind, SimulationEventKind::kFrictionLoss);
  EXPECT_NEAR(outcome.events[0].time, std::asin(0.01 / 0.3) * 1000 / (2 * M_PI), 0.05);
  EXPECT_EQ(outcome.report.end, SimulationEnd::kDuration);
  scene.contacts[0].friction_loss = FrictionLoss::kStop;
  outcome = Record(scene);
  EXPECT_EQ(outcome.report.end, SimulationEnd::kFrictionLoss);
  EXPECT_EQ(outcome.report.end_time, outcome.events[0].time);
}

// A walker that walks: every step hands the weight to the other foot, and the gait settles to the stable one.
TEST(Events, APassiveWalkerWalks) {
  SimulationScene scene =
      SceneOf(PassiveWalker{1, 0.5, 0.02, 0.5, 1, 0.2, 0.1, 0, 1, 0.01, 0.2356, -0.2849, -0.2356, -0.2263});
  scene.options.duration = 30;
  scene.options.output_step = 0.5;
  scene.options.tolerance = 1e-10;
  const RecordedSimulation outcome = Record(scene);
  ASSERT_GE(outcome.report.impacts, 10);
  for (size_t i = 0; i < outcome.events.size(); ++i) {
    EXPECT_EQ(outcome.events[i].kind, SimulationEventKind::kTouchDown);
    EXPECT_EQ(outcome.events[i].contact, i % 2 == 0 ? 1 : 0);
    EXPECT_EQ(outcome.events[i].released.size(), 1u);
    EXPECT_GT(outcome.events[i].energy_loss, 0);
  }
  const size_t n = outcome.events.size();
  EXPECT_NEAR(outcome.events[n - 1].time - outcome.events[n - 2].time, 2.512931056976196, 1e-4);
  EXPECT_LT(outcome.report.max_energy_error, 1e-8);
  EXPECT_GT(outcome.samples.back().q[0], 5);
}

TEST(Drift, ControlsKeepWhatTheySay) {
  BodyOnPlane body;
  body.surface = Ellipsoid(Vector3(0.3, 0.2, 0.1));
  body.inertia = Vector3(0.01, 0.02, 0.026).asDiagonal();
  body.orientation = Eigen::Quaterniond(0.9, 0.1, 0.3, 0.2);
  body.omega_body = Vector3(2, -1, 3);
  SimulationScene scene = SceneOf(body);
  scene.options.duration = 5;
  scene.options.tolerance = 1e-6;
  scene.options.drift = DriftControl::kNone;
  const double none = Record(scene).report.max_gap;
  scene.options.drift = DriftControl::kBaumgarte;
  scene.options.baumgarte = {30, 1, 30};
  const double baumgarte = Record(scene).report.max_gap;
  scene.options.drift = DriftControl::kProjection;
  const RecordedSimulation projected = Record(scene);
  EXPECT_GT(none, 3 * baumgarte);
  EXPECT_GT(none, 1e-9);
  for (const SimulationSample& sample : projected.samples) EXPECT_LT(std::abs(sample.contacts[0].gap), 1e-6);
  EXPECT_LT(projected.report.max_gap, none);
}

TEST(Drift, StopFlagAndObserverEndTheRun) {
  BodyOnPlane body;
  SimulationScene scene = SceneOf(body);
  StopFlag stop;
  stop.Request();
  EXPECT_EQ(Simulate(scene, {}, &stop).value().end, SimulationEnd::kStopped);
  SimulationObserver no;
  no.sample = [](const SimulationSample& sample) { return sample.time < 0.5; };
  const SimulationReport report = Simulate(scene, no).value();
  EXPECT_EQ(report.end, SimulationEnd::kStopped);
}

TEST(CheckScene, NamesWhatIsWrong) {
  const SimulationScene good = SceneOf(BodyOnPlane{});
  EXPECT_TRUE(CheckScene(good).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field = [&](auto change) {
    SimulationScene scene = good;
    change(scene);
    const Violations violations = CheckScene(scene);
    return violations.empty() ? std::string("nothing") : violations[0].field;
  };
  EXPECT_EQ(field([&](auto& s) { s.q[5] = nan; }), "joints[0].initial.position");
  EXPECT_EQ(field([&](auto& s) { s.v[0] = kInfinity; }), "joints[0].initial.velocity");
  EXPECT_EQ(field([&](auto& s) { s.q.template head<4>().setZero(); }), "joints[0].initial.orientation");
  EXPECT_EQ(field([&](auto& s) { s.efforts[0] = nan; }), "joints[0].effort");
  EXPECT_EQ(field([&](auto& s) {
              std::vector<Joint> joints = s.model.joints();
              joints[0].damping = 2 * kMaxSceneNumber;
              s.model = Model::Create(joints).value();
            }),
            "joints[0].damping");
  EXPECT_EQ(field([&](auto& s) { s.ground[1].rate = nan; }), "ground[1].rate_rad_s");
  EXPECT_EQ(field([&](auto& s) { s.contacts[0].friction = 0; }), "contacts[0].friction");
  EXPECT_EQ(field([&](auto& s) { s.contacts[0].active = false, s.contacts[0].bilateral = true; }),
            "contacts[0].bilateral");
  EXPECT_EQ(field([&](auto& s) { s.contacts[0].gates = {Gate{0, 0, 1}}; }), "contacts[0].gates[0].joint");
  EXPECT_EQ(field([&](auto& s) { s.gravity.x() = nan; }), "gravity_m_s2");
  EXPECT_EQ(field([&](auto& s) { s.options.duration = 1e9; }), "duration_s");
  EXPECT_EQ(field([&](auto& s) { s.options.output_step = 1e-9; }), "output_step_s");
  EXPECT_EQ(field([&](auto& s) { s.options.tolerance = 1e-20; }), "tolerance");
  EXPECT_EQ(field([&](auto& s) { s.options.max_steps = 0; }), "max_steps");
}

TEST(InitialState, RefusesContactsThatDoNotTouchOrRoll) {
  SimulationScene scene = SceneOf(BodyOnPlane{});
  scene.adjusted_joints.clear();
  scene.q[6] += 0.01;
  scene.v[3] = 1;
  const Result<SimulationReport> report = Simulate(scene, {});
  ASSERT_FALSE(report.ok());
  ASSERT_EQ(report.violations().size(), 2u);
  EXPECT_EQ(report.violations()[0].field, "contacts[0].active");
  EXPECT_NE(report.violations()[0].message.find("gap"), std::string::npos);
  EXPECT_NE(report.violations()[1].message.find("slips"), std::string::npos);
}

}  // namespace
}  // namespace rollgait
