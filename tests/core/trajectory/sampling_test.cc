#include "core/trajectory/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// Two phases of two intervals of different length, with random values at the points.
Trajectory RandomTrajectory(const std::vector<double>& fractions) {
  SeededRandom random(11);
  const int s = static_cast<int>(fractions.size());
  Trajectory trajectory;
  trajectory.points_per_interval = s;
  trajectory.point_fractions = fractions;
  for (int p = 0; p < 2; ++p) {
    TrajectoryPhase phase;
    phase.contacts = {0, 1};
    phase.start = p;
    phase.duration = 1;
    phase.node_times = {p + 0.0, p + 0.3, p + 1.0};
    const auto fill = [&random](int rows, int columns) {
      MatrixX m(rows, columns);
      for (int j = 0; j < columns; ++j) m.col(j) = random.VectorOf(rows, -1, 1);
      return m;
    };
    phase.node_positions = fill(4, 3);
    phase.node_velocities = fill(4, 3);
    phase.point_accelerations = fill(4, 2 * s);
    phase.point_efforts = fill(3, 2 * s);
    phase.point_forces = fill(6, 2 * s);
    trajectory.phases.push_back(phase);
  }
  return trajectory;
}

class SamplingTest : public ::testing::TestWithParam<std::vector<double>> {
 protected:
  Trajectory trajectory_ = RandomTrajectory(GetParam());
  int s_ = static_cast<int>(GetParam().size());
};

TEST_P(SamplingTest, InterpolatesThePoints) {
  for (int p = 0; p < 2; ++p) {
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < s_; ++i) {
        const MotionSample sample = Sample(trajectory_, p, k, GetParam()[i]);
        const TrajectoryPhase& phase = trajectory_.phases[p];
        EXPECT_TRUE(MatrixNear(sample.acceleration, phase.point_accelerations.col(k * s_ + i), 1e-13));
        EXPECT_TRUE(MatrixNear(sample.efforts, phase.point_efforts.col(k * s_ + i), 1e-13));
        EXPECT_TRUE(MatrixNear(sample.forces, phase.point_forces.col(k * s_ + i), 1e-13));
        EXPECT_TRUE(MatrixNear(SampleEfforts(trajectory_, p, k, GetParam()[i]), sample.efforts, 0));
      }
    }
  }
}

TEST_P(SamplingTest, StartsAtTheNode) {
  const MotionSample sample = Sample(trajectory_, 1, 1, 0);
  EXPECT_TRUE(MatrixNear(sample.position, trajectory_.phases[1].node_positions.col(1), 0));
  EXPECT_TRUE(MatrixNear(sample.velocity, trajectory_.phases[1].node_velocities.col(1), 0));
}

// The derivatives of position and velocity over time, by differences of order 4, which are exact for these polynomials.
TEST_P(SamplingTest, VelocityAndPositionAreIntegralsOfTheAcceleration) {
  const double length = 0.7, step = 0.1, theta = 0.4;
  const auto at = [this](double x) { return Sample(trajectory_, 0, 1, x); };
  const auto rate = [&](VectorX MotionSample::*member) {
    return VectorX((8 * (at(theta + step).*member - at(theta - step).*member) -
                    (at(theta + 2 * step).*member - at(theta - 2 * step).*member)) /
                   (12 * step * length));
  };
  EXPECT_TRUE(MatrixNear(rate(&MotionSample::position), at(theta).velocity, 1e-13));
  EXPECT_TRUE(MatrixNear(rate(&MotionSample::velocity), at(theta).acceleration, 1e-13));
}

// The polynomial has degree s − 1 and no more: its s-th difference vanishes, the one before does not.
TEST_P(SamplingTest, AccelerationHasTheDegreeOfTheScheme) {
  const auto difference = [this](int order) {
    VectorX sum = VectorX::Zero(4);
    double binomial = 1;
    for (int i = 0; i <= order; ++i) {
      sum += (i % 2 == 0 ? 1 : -1) * binomial * Sample(trajectory_, 0, 0, 0.2 * i).acceleration;
      binomial = binomial * (order - i) / (i + 1);
    }
    return sum.norm();
  };
  EXPECT_LT(difference(s_), 1e-13);
  EXPECT_GT(difference(s_ - 1), 1e-3);
}

TEST_P(SamplingTest, ReusesItsVectors) {
  const IntervalPolynomials interval(trajectory_, 0, 1);
  EXPECT_EQ(interval.start(), 0.3);
  EXPECT_EQ(interval.length(), 0.7);
  MotionSample sample;
  interval.Evaluate(0.9, &sample);
  const double* data = sample.position.data();
  interval.Evaluate(0.25, &sample);
  EXPECT_EQ(sample.position.data(), data);
  EXPECT_TRUE(MatrixNear(sample.position, Sample(trajectory_, 0, 1, 0.25).position, 0));
}

// Radau IIA with 2 and 3 points, and the three points of Hermite–Simpson.
TEST_P(SamplingTest, FilledPointStatesAreSamples) {
  FillPointStates(&trajectory_);
  for (int p = 0; p < 2; ++p) {
    const TrajectoryPhase& phase = trajectory_.phases[p];
    ASSERT_EQ(phase.point_positions.cols(), 2 * s_);
    for (int column = 0; column < 2 * s_; ++column) {
      const MotionSample sample = Sample(trajectory_, p, column / s_, GetParam()[column % s_]);
      EXPECT_TRUE(MatrixNear(phase.point_positions.col(column), sample.position, 0));
      EXPECT_TRUE(MatrixNear(phase.point_velocities.col(column), sample.velocity, 0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, SamplingTest,
                         ::testing::Values(std::vector<double>{1.0 / 3, 1.0},
                                           std::vector<double>{(4 - std::sqrt(6)) / 10, (4 + std::sqrt(6)) / 10, 1.0},
                                           std::vector<double>{0.0, 0.5, 1.0}));

TEST(Sampling, PhasesWithoutContactsAndEfforts) {
  Trajectory trajectory = RandomTrajectory({1.0 / 3, 1.0});
  trajectory.phases[0].contacts.clear();
  trajectory.phases[0].point_forces.resize(0, 0);
  trajectory.phases[0].point_efforts.resize(0, 4);
  const MotionSample sample = Sample(trajectory, 0, 1, 0.5);
  EXPECT_EQ(sample.forces.size(), 0);
  EXPECT_EQ(sample.efforts.size(), 0);
  EXPECT_EQ(sample.position.size(), 4);
}

TEST(SamplingDeathTest, IndicesOutOfRange) {
  const Trajectory trajectory = RandomTrajectory({1.0 / 3, 1.0});
  EXPECT_DEATH(Sample(trajectory, 2, 0, 0.5), "contract violated");
  EXPECT_DEATH(Sample(trajectory, 0, 2, 0.5), "contract violated");
}

}  // namespace
}  // namespace rollgait
