// Samples of a simulation: their number, their cost and their accuracy; and tolerances of scenes with other units of
// time.
#include <gtest/gtest.h>

#include <cmath>

#include "core/simulation/simulation.h"
#include "tests/support/matrix_near.h"
#include "tests/support/recorded_simulation.h"
#include "tests/support/rolling_scenes.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using testing::Record, testing::RecordedSimulation;

SimulationScene FreeBody() {
  SimulationScene scene = SceneOf(BodyOnPlane{});
  scene.contacts.clear();
  scene.adjusted_joints.clear();
  scene.gravity.setZero();
  scene.v << 0, 0, 0.5, 1, 0, 0;
  return scene;
}

// A triaxial ellipsoid that rolls; `faster`: the same motion in a shorter time.
SimulationScene Rolling(double faster) {
  BodyOnPlane body;
  body.surface = Ellipsoid(Vector3(0.3, 0.2, 0.1));
  body.inertia = Vector3(0.01, 0.02, 0.026).asDiagonal();
  body.orientation = Eigen::Quaterniond(0.9, 0.1, 0.3, 0.2);
  body.omega_body = faster * Vector3(2, -1, 3);
  body.gravity = Vector3(0, 0, -9.81 * faster * faster);
  SimulationScene scene = SceneOf(body);
  scene.options.duration = 2 / faster;
  scene.options.output_step = 0.01 / faster;
  return scene;
}

// However the product of number and step is rounded: 13 · 0.29 is less than 3.77.
TEST(Sampling, ThereIsASampleForEachStepAndOneAtTheEnd) {
  SeededRandom random(3);
  for (int i = 0; i < 300; ++i) {
    SimulationScene scene = FreeBody();
    const int count = 1 + static_cast<int>(random.Uniform(0, 40));
    const int thousandths = 1 + static_cast<int>(random.Uniform(0, 999));
    scene.options.output_step = thousandths / 1000.0;
    scene.options.duration = thousandths * count / 1000.0;  // the decimal number nearest to the product
    const RecordedSimulation outcome = Record(scene);
    ASSERT_EQ(outcome.samples.size(), static_cast<size_t>(count) + 1) << thousandths;
    EXPECT_EQ(outcome.samples.back().time, scene.options.duration);
  }
  SimulationScene scene = FreeBody();
  scene.options.output_step = 0.4;
  EXPECT_EQ(Record(scene).samples.size(), 4u);  // 0, 0.4, 0.8 and the end
}

TEST(Sampling, ManySamplesOfAStepTakeOneEvaluationEach) {
  SimulationScene scene = FreeBody();
  scene.options.output_step = 0.001;
  const RecordedSimulation outcome = Record(scene);
  EXPECT_EQ(outcome.samples.size(), 1001u);
  EXPECT_LE(outcome.report.evaluations, 1001 + 100 * outcome.report.steps);
  for (const SimulationSample& sample : outcome.samples) EXPECT_NEAR(sample.q[4], sample.time, 1e-9);
}

// Samples do not change the motion, and those between its steps are as accurate as these.
TEST(Sampling, SamplesAreAsAccurateAsTheSteps) {
  for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
    SimulationScene scene = Rolling(1);
    scene.options.tolerance = 1e-13;
    const RecordedSimulation exact = Record(scene);
    scene.options.tolerance = tolerance;
    scene.options.output_step = 1;
    const RecordedSimulation coarse = Record(scene);
    scene.options.output_step = 0.01;
    const RecordedSimulation fine = Record(scene);
    EXPECT_TRUE(MatrixNear(coarse.report.q, fine.report.q, 0));
    double at_end = 0, between = 0;
    for (size_t i = 0; i < exact.samples.size(); ++i) {
      between = std::max(between, (exact.samples[i].q - fine.samples[i].q).cwiseAbs().maxCoeff());
    }
    at_end = (exact.report.q - fine.report.q).cwiseAbs().maxCoeff();
    EXPECT_LE(between, 3 * at_end + 10 * tolerance) << tolerance;
  }
}

// With one tolerance for both, an error of 1e-9 rad/s is large beside slow speeds and nothing beside fast ones.
TEST(Sampling, ASmallAbsoluteToleranceLeavesTheUnitOfTimeFree) {
  const auto difference = [](std::optional<double> absolute_tolerance) {
    SimulationScene slow = Rolling(1), fast = Rolling(1e-3);
    slow.options.tolerance = fast.options.tolerance = 1e-7;
    slow.options.absolute_tolerance = fast.options.absolute_tolerance = absolute_tolerance;
    return (Record(slow).report.q - Record(fast).report.q).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(difference(std::nullopt), 1e-7);
  EXPECT_LT(difference(1e-20), 1e-10);
}

}  // namespace
}  // namespace rollgait
