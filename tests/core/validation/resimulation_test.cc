#include "core/validation/resimulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/constrained_dynamics.h"
#include "core/math/integrator.h"
#include "tests/support/rolling_body.h"

namespace rollgait {
namespace {

// The reference trajectory of a triaxial ellipsoid as nodes: what lies between them is the judge's own integration.
class ReferenceNodes : public ::testing::Test {
 protected:
  ReferenceNodes() {
    const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/triaxial_tri_08_side_tilt10.csv");
    TrajectoryPhase phase;
    phase.contacts = {0};
    phase.node_positions.resize(6, 21);
    phase.node_velocities.resize(6, 21);
    VectorX q, v;
    for (int k = 0; k < 21; ++k) {
      SetRolling(kAxes, rows[k].R, rows[k].R * rows[k].omega, rows[k].x, rows[k].y, &q, &v);
      // Yaw and roll are continuous along the trajectory, atan2 is not.
      for (int j = 3; j < 6 && k > 0; ++j) {
        q[j] += 2 * M_PI * std::round((phase.node_positions(j, k - 1) - q[j]) / (2 * M_PI));
      }
      phase.node_positions.col(k) = q;
      phase.node_velocities.col(k) = v;
      phase.node_times.push_back(rows[k].t);
    }
    phase.point_accelerations.setZero(6, 40);
    phase.point_efforts.resize(0, 40);
    phase.point_forces.setZero(3, 40);
    trajectory_.point_fractions = {1.0 / 3, 1.0};
    trajectory_.cycle = Cycle::kFull;
    trajectory_.phases.push_back(phase);
  }

  Resimulation Run(double tolerance, int most_steps = 2000) {
    ForceExtremes forces(0.365 * 9.81);
    const Resimulation result = Resimulate(scene_, BodyDynamics(scene_.model), trajectory_, kGravity, tolerance,
                                           most_steps, {}, &forces, &log_);
    min_normal_ = forces.min_normal();
    max_friction_ = forces.max_friction_ratio();
    return result;
  }

  static inline const Vector3 kAxes{0.319, 0.242, 0.098};
  static inline const Vector3 kGravity{1.7034886229125867, 0, -9.66096405704976};
  RollingBody body_ = MakeRollingBody(kAxes, 0.365, Vector3::Zero(),
                                      Vector3(0.004976264, 0.008129645, 0.011703724999999998).asDiagonal());
  Scene scene_{"ellipsoid", "", {}, body_.model, {body_.surface}, 1.0, {}};
  Trajectory trajectory_;
  double min_normal_ = 0, max_friction_ = 0;
  FindingLog log_{20};
};

TEST_F(ReferenceNodes, EveryIntervalEndsOnTheNextNode) {
  const Resimulation result = Run(1e-11);
  ASSERT_EQ(result.interval_positions.size(), 20u);
  for (int k = 0; k < 20; ++k) {
    // An interval of 0.3 s grows errors some tens of times; yaw and roll rates some more near a steep pitch.
    EXPECT_LT(result.interval_positions[k], 1e-9) << k;
    EXPECT_LT(result.interval_velocities[k], 1e-9) << k;
  }
  // The motion is not periodic, which the end of the last interval says.
  EXPECT_GT(result.position.value, 0.1);
  EXPECT_EQ(result.position.time, trajectory_.phases[0].node_times.back());
  // The reference's least normal force over m g is 0.49657 at steps of 0.02 s; other steps meet the dip at other times.
  EXPECT_NEAR(min_normal_ / (0.365 * 9.81), 0.4966, 0.005);
}

// The least normal force at every instant: against forward dynamics at 400 instants of every interval, integrated from
// each to the next. The judge takes one to four steps an interval, and its least force is between them.
TEST_F(ReferenceNodes, ForcesBetweenAcceptedSteps) {
  Run(1e-10);
  ConstrainedDynamics dynamics(BodyDynamics(scene_.model), {body_.surface});
  const VectorX no_effort = VectorX::Zero(6);
  double least = kInfinity, friction = 0;
  Dop853 integrator;
  const auto right_side = [&](double, const VectorX& x, VectorX* derivative) {
    derivative->head(6) = x.tail(6);
    derivative->tail(6) = dynamics.Evaluate(x.head(6), x.tail(6), no_effort, kGravity).acceleration;
  };
  for (int k = 0; k < 20; ++k) {
    VectorX x(12);
    x << trajectory_.phases[0].node_positions.col(k), trajectory_.phases[0].node_velocities.col(k);
    const double h = (trajectory_.phases[0].node_times[k + 1] - trajectory_.phases[0].node_times[k]) / 400;
    for (int i = 0; i < 400; ++i) {
      Dop853::Options options;
      options.tolerance = 1e-11;
      ASSERT_EQ(integrator.Integrate(right_side, 0, h, options, &x), IntegrationStatus::kReachedEnd);
      const Vector3 force = dynamics.Force(0);
      least = std::min(least, force.z());
      friction = std::max(friction, force.head<2>().norm() / force.z());
    }
  }
  // Within a thousandth, and not less than what the fine grid sees but for its own coarseness, (h/2)² times a
  // curvature.
  EXPECT_NEAR(min_normal_, least, 1e-4 * least);
  EXPECT_NEAR(max_friction_, friction, 1e-4 * friction);
}

// Longer steps do not make forces less exact than the motion: where the quintic through the ends of a step or an
// interpolant is not good enough, the judge knows. Measured: 6e-8 N; 6e-6 N with the quintic everywhere, 5e-5 N without
// halving.
TEST_F(ReferenceNodes, ForcesOfLongSteps) {
  Run(1e-11);
  const double normal = min_normal_, friction = max_friction_;
  Run(1e-6);
  EXPECT_NEAR(min_normal_, normal, 5e-7);
  EXPECT_NEAR(max_friction_, friction, 5e-7);
}

TEST_F(ReferenceNodes, DefectsFallWithTheTolerance) {
  const auto worst = [this](double tolerance) {
    const Resimulation result = Run(tolerance);
    return *std::max_element(result.interval_velocities.begin(), result.interval_velocities.end());
  };
  const double coarse = worst(1e-5), fine = worst(1e-9);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_LT(fine, 1e-2 * coarse);
}

TEST_F(ReferenceNodes, AnIntervalThatCannotBeIntegratedIsInfinitelyWrong) {
  trajectory_.phases[0].node_velocities(4, 3) = 1e200;
  const Resimulation result = Run(1e-10);
  EXPECT_EQ(result.position.value, kInfinity);
  EXPECT_EQ(result.velocity.value, kInfinity);
  EXPECT_EQ(result.position.time, trajectory_.phases[0].node_times[4]);
  // The others are judged all the same, but for the one that ends in the wrong node.
  ASSERT_EQ(result.interval_positions.size(), 20u);
  EXPECT_EQ(result.interval_positions[3], kInfinity);
  for (int k = 4; k < 20; ++k) EXPECT_LT(result.interval_positions[k], 1e-9) << k;
}

TEST_F(ReferenceNodes, AnIntervalThatTakesTooManyStepsIsNotIntegrated) {
  for (const double defect : Run(1e-10, 1).interval_positions) EXPECT_EQ(defect, kInfinity);
  for (const double defect : Run(1e-10, 200).interval_positions) EXPECT_LT(defect, 1e-9);
}

TEST_F(ReferenceNodes, AnotherGravityIsAnotherMotion) {
  ForceExtremes forces(1);
  const Resimulation result = Resimulate(scene_, BodyDynamics(scene_.model), trajectory_, Vector3(0, 0, -9.81), 1e-10,
                                         2000, {}, &forces, &log_);
  for (double defect : result.interval_velocities) EXPECT_GT(defect, 1e-3);
}

}  // namespace
}  // namespace rollgait
