// Bodies that roll, simulated through the scene and compared with closed forms and published trajectories.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "core/simulation/simulation.h"
#include "tests/support/matrix_near.h"
#include "tests/support/rolling_scenes.h"
#include "tests/support/standing_plate.h"

namespace rollgait {
namespace {

std::vector<SimulationSample> Samples(const SimulationScene& scene, SimulationReport* report) {
  EXPECT_TRUE(CheckScene(scene).empty());
  std::vector<SimulationSample> samples;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    samples.push_back(sample);
    return true;
  };
  Result<SimulationReport> result = Simulate(scene, observer);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.violations()[0].field + result.violations()[0].message);
  if (result.ok()) *report = result.value();
  return samples;
}

BodyOnPlane Ball(double radius, double mass) {
  BodyOnPlane ball;
  ball.surface = Sphere(radius);
  ball.mass = mass;
  ball.inertia = 0.4 * mass * radius * radius * Matrix3::Identity();
  return ball;
}

TEST(RollingSimulation, BallOnInclineAcceleratesByFiveSevenths) {
  BodyOnPlane ball = Ball(0.1, 2.5);
  const double slope = 10 * M_PI / 180;
  ball.gravity = 9.81 * Vector3(std::sin(slope), 0, -std::cos(slope));
  ball.omega_body = Vector3(-3, -20, 300);  // spin changes nothing
  SimulationScene scene = SceneOf(ball);
  scene.options.duration = 2;
  scene.options.output_step = 0.25;
  scene.options.tolerance = 1e-11;
  SimulationReport report;
  const std::vector<SimulationSample> samples = Samples(scene, &report);
  ASSERT_EQ(samples.size(), 9u);
  const double a = 5.0 / 7 * 9.81 * std::sin(slope);
  const Vector3 v0(-2, 0.3, 0);  // ω × r upwards
  for (const SimulationSample& sample : samples) {
    const double t = sample.time;
    EXPECT_TRUE(MatrixNear(Vector3(sample.q.tail(3)), v0 * t + Vector3(0.5 * a * t * t, 0, 0.1), 1e-8)) << t;
    EXPECT_TRUE(MatrixNear(sample.contacts[0].force,
                           Vector3(2.5 * (a - 9.81 * std::sin(slope)), 0, 2.5 * 9.81 * std::cos(slope)), 1e-8));
  }
  EXPECT_EQ(report.end, SimulationEnd::kDuration);
  EXPECT_EQ(report.end_time, 2);
  EXPECT_LT(report.max_energy_error, 1e-8);
  EXPECT_NEAR(report.max_friction_ratio, 2.0 / 7 * std::tan(slope), 1e-9);
}

// A ball on a turntable runs on a circle at 2/7 of its angular velocity, whatever its radius and spin.
TEST(RollingSimulation, BallOnTurntableCirclesAtTwoSevenths) {
  BodyOnPlane ball = Ball(0.1, 1);
  ball.ground.rate = 7;
  ball.contact_point = Vector3(0.2, 0, 0);
  // v = (0.5, 0.3, 0) at (0.2, 0): slip zero wants  v − Ω×p = −ω×r  with r = (0, 0, −0.1).
  ball.omega_body = Vector3((0.2 * 7 - 0.3) / 0.1, 0.5 / 0.1, 3);
  SimulationScene scene = SceneOf(ball);
  scene.options.duration = M_PI;  // one turn at 2 rad/s
  scene.options.output_step = M_PI / 8;
  scene.options.tolerance = 1e-12;
  SimulationReport report;
  const std::vector<SimulationSample> samples = Samples(scene, &report);
  for (const SimulationSample& sample : samples) {
    const Vector3 arm(0.15, -0.25, 0);
    const Vector3 p = Vector3(0.05, 0.25, 0) + Eigen::AngleAxisd(2 * sample.time, Vector3::UnitZ()) * arm;
    EXPECT_TRUE(MatrixNear(sample.contacts[0].point, p, 1e-9)) << sample.time;
  }
  EXPECT_LT(report.max_energy_error, 1e-9);  // the turntable's work is in the balance
  EXPECT_GT(std::abs(samples[3].work), 1e-3);
}

TEST(RollingSimulation, BallOnAcceleratedPlaneTakesTwoSevenths) {
  BodyOnPlane ball = Ball(0.1, 1);
  ball.ground.acceleration = Vector3(2, -1, 0);
  SimulationScene scene = SceneOf(ball);
  scene.options.tolerance = 1e-12;
  SimulationReport report;
  const SimulationSample end = Samples(scene, &report).back();
  EXPECT_TRUE(MatrixNear(Vector3(end.q.tail(3)), Vector3(1 / 3.5, -0.5 / 3.5, 0.1), 1e-11));
  EXPECT_TRUE(MatrixNear(end.contacts[0].force, Vector3(2 / 3.5, -1 / 3.5, 9.81), 1e-10));
}

BodyOnPlane Stone() {
  BodyOnPlane stone;
  stone.surface = Ellipsoid(Vector3(0.2, 0.03, 0.02));
  stone.center_of_mass = Vector3(0, 0, 0.01);
  stone.inertia << 2e-4, -2e-5, 0, -2e-5, 1.6e-3, 0, 0, 0, 1.7e-3;
  stone.orientation =
      Eigen::Quaterniond(-0.004363267749186967, 0.9999809615320856, -1.9038467914355635e-05, 0.004363267749186967);
  stone.omega_body = Vector3(0, 0, -5);
  return stone;
}

// The published trajectory, some of its rows (tests/data says where it is from).
TEST(RollingSimulation, RattlebackFollowsTheReference) {
  SimulationScene scene = SceneOf(Stone());
  scene.options.duration = 2.6;
  scene.options.output_step = 0.2;
  scene.options.tolerance = 1e-12;
  SimulationReport report;
  const std::vector<SimulationSample> samples = Samples(scene, &report);
  std::ifstream file(ROLLGAIT_TEST_DATA "/rattleback_KL82_undamped.csv");
  std::string line;
  while (std::getline(file, line) && line[0] != 't') {
  }
  double worst_rotation = 0, worst_force = 0;
  int rows = 0;
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    const size_t i = static_cast<size_t>(std::lround(row[0] / 0.2));
    if (i >= samples.size()) break;
    ++rows;
    ASSERT_NEAR(row[0], samples[i].time, 1e-12);
    const Eigen::Quaterniond expected(row[1], row[2], row[3], row[4]);
    const Eigen::Quaterniond actual(samples[i].q[0], samples[i].q[1], samples[i].q[2], samples[i].q[3]);
    worst_rotation = std::max(worst_rotation, (expected.toRotationMatrix() - actual.toRotationMatrix()).norm());
    worst_force = std::max(worst_force, (samples[i].contacts[0].force - Vector3(row[16], row[17], row[18])).norm());
  }
  EXPECT_GE(rows, 3);
  // Perturbations grow to 5000 times their size within these 2.6 s; the weight is 9.81 N.
  EXPECT_LT(worst_rotation, 1e-9);
  EXPECT_LT(worst_force, 1e-7);
  EXPECT_LT(report.max_energy_error, 1e-11);
  EXPECT_LT(report.max_gap, 1e-12);
  EXPECT_LT(report.max_slip, 1e-10);
}

// Spin about the vertical at time t.
double SpinAt(double t) {
  SimulationScene scene = SceneOf(Stone());
  scene.options.duration = scene.options.output_step = t;
  scene.options.tolerance = 1e-12;
  SimulationReport report;
  const VectorX q = Samples(scene, &report).back().q;
  return (Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3(report.v.head(3))).z();
}

TEST(RollingSimulation, RattlebackReversesWhenItShould) {
  double a = 2.76, b = 2.762, at_a = SpinAt(a), at_b = SpinAt(b);
  ASSERT_LT(at_a * at_b, 0);
  for (int i = 0; i < 6 && std::abs(b - a) > 1e-12; ++i) {
    const double c = b - at_b * (b - a) / (at_b - at_a);
    a = b, at_a = at_b;
    b = c, at_b = SpinAt(c);
  }
  EXPECT_NEAR(b, 2.761109153800631, 1e-9);
}

// A plate on three frictionless feet, one almost on the line of the others: forces that have no digit left are
// reported.
TEST(Standing, NearlyRedundantContactsAreReported) {
  for (const double delta : {1e-3, 1e-6, 1e-9, 1e-12}) {
    SimulationScene scene{
        "plate", testing::StandingPlate::MakeModel(), {0.0}, {GroundMotion{}}, {}, {0, 0, -9.81}, {}, {}, {}, -1, {}};
    for (TreeContact& contact :
         testing::StandingPlate::Contacts({{-1, 0.3, 0}, {1, 0.3, 0}, {0, 0.3 + delta, 0}}, Grip::kFrictionless)) {
      SceneContact touching;
      touching.contact = contact;
      touching.contact.name = std::to_string(scene.contacts.size());
      touching.active = touching.bilateral = true;
      scene.contacts.push_back(touching);
    }
    scene.q = NeutralConfiguration(scene.model);
    scene.q[6] = 0.5;
    scene.v = VectorX::Zero(6);
    scene.options.duration = 0.1;
    ASSERT_TRUE(CheckScene(scene).empty());
    const SimulationReport report = Simulate(scene, {}).value();
    EXPECT_EQ(report.end, SimulationEnd::kDuration);
    EXPECT_EQ(report.redundant, delta < 1e-8) << delta;
    // At rest but where the third foot counts as one on the line; then the plate falls about it.
    EXPECT_EQ(report.v.norm() > 1e-6, delta < 1e-10) << delta;
  }
}

}  // namespace
}  // namespace rollgait
