#include "client/report/stride.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

class StrideTest : public testing::Test {
 protected:
  const v1::Model model_ = SampleModel();
  const Stride stride_ = BuildStride(SampleTrajectory(model_), model_, kSampleSpan_s, 200);
};

TEST_F(StrideTest, IsAWholeCycle) {
  ASSERT_EQ(stride_.samples.size(), 201u);
  EXPECT_DOUBLE_EQ(stride_.duration_s, 2 * kSampleSpan_s);
  EXPECT_DOUBLE_EQ(stride_.displacement_m, 2 * kSampleDisplacement_m);
}

// The sample's closed form goes on for ever: the stride is the closed form from the right heel strike on, which the
// mirrored half must reproduce.
TEST_F(StrideTest, MirroredHalfContinuesTheMotion) {
  for (const StrideSample& sample : stride_.samples) {
    for (int j = 0; j < model_.joints_size(); ++j) {
      EXPECT_NEAR(sample.instant.position[j], SamplePosition(model_, j, kSampleSpan_s + sample.time_s), 5e-5)
          << model_.joints(j).name() << " at " << sample.percent << " %";
    }
  }
}

TEST_F(StrideTest, EndIsTheStartMovedForward) {
  const Instant& start = stride_.samples.front().instant;
  const Instant& end = stride_.samples.back().instant;
  EXPECT_NEAR(end.position[0] - start.position[0], 2 * kSampleDisplacement_m, 1e-4);
  for (int j = 1; j < model_.joints_size(); ++j) EXPECT_NEAR(end.position[j], start.position[j], 1e-4);
}

TEST_F(StrideTest, ForcesAreThoseOfTheActiveFoot) {
  const double weight = model_.total_mass_kg() * model_.gravity_m_s2();
  // 30 %: single support on the right foot; 80 %: on the left one.
  EXPECT_NEAR(stride_.samples[60].instant.force[1][2], weight, 1e-9);
  EXPECT_EQ(stride_.samples[60].instant.force[0][2], 0);
  EXPECT_NEAR(stride_.samples[160].instant.force[0][2], weight, 1e-9);
  EXPECT_EQ(stride_.samples[160].instant.force[1][2], 0);
  // The landing foot takes over the weight in double support.
  EXPECT_LT(stride_.samples[1].instant.force[1][2], 0.1 * weight);
  EXPECT_GT(stride_.samples[19].instant.force[1][2], 0.9 * weight);
}

TEST_F(StrideTest, FullCycleIsNotMirrored) {
  v1::Trajectory trajectory = SampleTrajectory(model_);
  trajectory.set_cycle(v1::CYCLE_FULL);
  const Stride stride = BuildStride(trajectory, model_, 0, 10);
  EXPECT_DOUBLE_EQ(stride.duration_s, kSampleSpan_s);
  EXPECT_NEAR(stride.samples[3].instant.position[4], SamplePosition(model_, 4, 0.3 * kSampleSpan_s), 5e-5);
}

// Wherever the cycle is said to begin, there it begins.
TEST_F(StrideTest, BeginsWhereItIsTold) {
  for (const double start : {0.0, 0.2, 0.7, 1.05}) {
    const Stride stride = BuildStride(SampleTrajectory(model_), model_, start, 20);
    for (const StrideSample& sample : stride.samples) {
      EXPECT_NEAR(sample.instant.position[4], SamplePosition(model_, 4, start + sample.time_s), 5e-5) << start;
    }
  }
  EXPECT_THROW(BuildStride(SampleTrajectory(model_), model_, 2 * kSampleSpan_s, 20), Failure);
  EXPECT_THROW(BuildStride(SampleTrajectory(model_), model_, -0.1, 20), Failure);
}

TEST(MirrorTest, ExchangesSidesAndTwiceIsNothing) {
  v1::Model model = SampleModel();
  model.mutable_joints(2)->set_mirror_sign(-1);  // As the roll of a spatial base.
  Instant instant;
  for (int i = 0; i < model.joints_size(); ++i) {
    instant.position.push_back(i + 1);
    instant.velocity.push_back(10 * i + 1);
    instant.effort.push_back(100 * i + 1);
  }
  instant.force = {{1, 2, 3}, {4, 5, 6}};
  instant.active = {true, false};
  const Instant image = Mirror(instant, model);
  EXPECT_EQ(image.position[2], -3);
  EXPECT_EQ(image.position[3], 7);
  EXPECT_EQ(image.effort[6], 301);
  EXPECT_THAT(image.force[0], testing::ElementsAre(4, -5, 6));
  EXPECT_THAT(image.active, testing::ElementsAre(false, true));
  const Instant twice = Mirror(image, model);
  EXPECT_EQ(twice.position, instant.position);
  EXPECT_EQ(twice.force, instant.force);
}

TEST(ForwardShiftTest, OnlyTheForwardJointOfTheBase) {
  const v1::Model model = SampleModel();
  EXPECT_THAT(ForwardShift(model, 0.7), testing::ElementsAre(0.7, 0, 0, 0, 0, 0, 0, 0, 0));
}

}  // namespace
}  // namespace rollgait::client
