#include "core/models/rolling_ellipsoid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;

OrientationChart RandomChart(SeededRandom* random) {
  OrientationChart chart;
  chart.world = Eigen::AngleAxisd(random->Uniform(-3, 3), random->Unit()).toRotationMatrix();
  chart.body = Eigen::AngleAxisd(random->Uniform(-3, 3), random->Unit()).toRotationMatrix();
  return chart;
}

RollingEllipsoidRequest Pebble() {
  RollingEllipsoidRequest request;
  request.semi_axes = Vector3(0.2, 0.15, 0.1);
  request.mass = 2.5;
  return request;
}

// The tree says where the body is and how it turns; the chart's functions say the same.
TEST(RollingEllipsoidTest, ChartIsThatOfTheTree) {
  SeededRandom random(1);
  for (int k = 0; k < 50; ++k) {
    const OrientationChart chart = RandomChart(&random);
    const Scene scene = RollingEllipsoidScene(Pebble(), chart).value();
    const BodyDynamics dynamics(scene.model);
    VectorX q = random.VectorOf(6, -3, 3);
    q(4) *= OrientationChart::kLargestTilt / 3;
    const VectorX v = random.VectorOf(6, -2, 2);
    BodyDynamics::State state;
    dynamics.ComputeState(q, v, &state);
    const Matrix3 R_WB = state.back().R_WL * scene.contacts.front().R_LE;
    EXPECT_TRUE(MatrixNear(ChartRotation(chart, q.tail<3>()), R_WB, 1e-14));
    EXPECT_TRUE(MatrixNear(ChartRates(chart, q.tail<3>()) * v.tail<3>(), state.back().R_WL * state.back().twist.angular,
                           1e-13));
    EXPECT_TRUE(MatrixNear(ChartRotation(chart, ChartAngles(chart, R_WB)), R_WB, 1e-13));
    EXPECT_TRUE(MatrixNear(ChartOf(scene).world, chart.world, 0));
    EXPECT_TRUE(MatrixNear(ChartOf(scene).body, chart.body, 0));
  }
}

// The body does not know of the chart: same pose and velocity, same energy.
TEST(RollingEllipsoidTest, EnergyDoesNotDependOnTheChart) {
  SeededRandom random(2);
  const Scene plain = RollingEllipsoidScene(Pebble(), {}).value();
  for (int k = 0; k < 50; ++k) {
    const Scene turned = InChart(plain, RandomChart(&random));
    const Vector3 omega = random.Vector(-2, 2), place = random.Vector(-1, 1), velocity = random.Vector(-1, 1);
    Matrix3 R_WB = Eigen::AngleAxisd(0.3, random.Unit()).toRotationMatrix();
    double energy[2];
    int i = 0;
    for (const Scene* scene : {&plain, &turned}) {
      const OrientationChart chart = ChartOf(*scene);
      const Vector3 angles = ChartAngles(chart, R_WB);
      VectorX q(6), v(6);
      q << place, angles;
      v << velocity, ChartRates(chart, angles).inverse() * omega;
      const BodyDynamics dynamics(scene->model);
      BodyDynamics::State state;
      dynamics.ComputeState(q, v, &state);
      energy[i++] = dynamics.KineticEnergy(state);
    }
    const Vector3 body_omega = R_WB.transpose() * omega;
    const Vector3 moments = plain.selection.rolling_body->moments;
    const double expected = 0.5 * 2.5 * velocity.squaredNorm() + 0.5 * body_omega.dot(moments.cwiseProduct(body_omega));
    EXPECT_NEAR(energy[0], expected, 1e-10 * expected);  // the chart may come close to its edge
    EXPECT_NEAR(energy[1], expected, 1e-10 * expected);
  }
}

TEST(RollingEllipsoidTest, DefaultIsAHomogeneousBall) {
  BodyRequest request;
  request.model = "ball";
  const Scene scene = BuildScene(request).value();
  EXPECT_EQ(scene.selection.rolling_body->semi_axes, Vector3::Constant(0.1));
  EXPECT_TRUE(MatrixNear(scene.selection.rolling_body->moments, Vector3::Constant(0.4 * 0.01), 1e-16));
  EXPECT_EQ(scene.model.size(), 6);
  EXPECT_EQ(scene.model.actuated().size(), 3u);
  EXPECT_EQ(scene.FindContact("surface"), 0);
}

TEST(RollingEllipsoidTest, RefusesWithFieldValueAndLimit) {
  BodyRequest request;
  request.model = "ball";
  const auto refused = [&](const char* field, const char* words) {
    const Result<Scene> scene = BuildScene(request);
    ASSERT_FALSE(scene.ok()) << field;
    ASSERT_EQ(scene.violations().size(), 1u) << field << ": one cause, one message";
    EXPECT_EQ(scene.violations()[0].field, field);
    EXPECT_THAT(scene.violations()[0].message, HasSubstr(words));
  };
  request.rolling_body.emplace().semi_axes = Vector3(0.1, 0.1, 0.001);
  refused("rolling_body.semi_axes_m", "between 0.01 and 10 m");
  request.rolling_body.emplace().semi_axes = Vector3(1, 1, 0.02);
  refused("rolling_body.semi_axes_m", "20 times");
  request.rolling_body.emplace().mass = std::numeric_limits<double>::quiet_NaN();
  refused("rolling_body.mass_kg", "between 0.001 and 1e6 kg");
  request.rolling_body.emplace().mass = -1;
  refused("rolling_body.mass_kg", "is -1; must be between 0.001 and 1e6 kg");
  request.rolling_body.emplace().moments = Vector3(1, 1, 3);
  refused("rolling_body.moments_kg_m2", "no rigid body");
  request.rolling_body.emplace().moments = Vector3(1, 0, 1);
  refused("rolling_body.moments_kg_m2", "larger than 0");
  request.rolling_body.reset();
  request.stature = 1.8;
  refused("stature_m", "leave it out");
  request = {};
  request.model = "planar";
  request.rolling_body.emplace();
  refused("rolling_body", "\"ball\" only");
}

}  // namespace
}  // namespace rollgait
