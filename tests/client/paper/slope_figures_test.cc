// The sample's torques are A (sin φ + 0.4 cos 2φ): their integrals over the stride are known.
#include "client/paper/slope_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

constexpr double kStride_s = 2 * kSampleSpan_s;

TEST(SlopeFiguresTest, EffortsOfEveryJointAreTheClosedForm) {
  const SlopeFigures figures = MeasureSlope(SampleSolve("solves/a", 0.1));
  EXPECT_NEAR(figures.slope_deg, 5.7296, 1e-4);
  EXPECT_EQ(figures.solve, "solves/a");
  EXPECT_TRUE(figures.solved);
  EXPECT_TRUE(figures.mirrored);
  ASSERT_EQ(figures.joints.size(), 6u);
  const std::map<std::string, double> amplitudes = {{"hip", 45}, {"knee", 30}, {"ankle", 60}};
  double squared = 0;
  for (const JointEffort& effort : figures.joints) {
    const double amplitude = amplitudes.at(effort.joint.substr(0, effort.joint.size() - 2));
    const double expected = amplitude * amplitude * (1 + 0.16) / 2 * kStride_s;
    EXPECT_NEAR(effort.squared, expected, 2e-3 * expected) << effort.joint;  // linear between the points of the mesh
    EXPECT_LE(effort.absolute, std::sqrt(effort.squared * kStride_s)) << effort.joint;  // Schwarz
    EXPECT_GE(effort.absolute, effort.squared / effort.peak) << effort.joint;
    EXPECT_LE(effort.peak, 1.4 * amplitude * 1.01) << effort.joint;
    EXPECT_GT(effort.positive_work, 0) << effort.joint;
    EXPECT_GT(effort.negative_work, 0) << effort.joint;
    squared += expected;
  }
  EXPECT_NEAR(figures.total.squared, squared, 2e-3 * squared);
  EXPECT_NEAR(figures.total.peak, figures.joints[2].peak, 0.05);  // the ankles have the largest torque
}

// Net work of a joint in closed form: only terms of equal frequency in torque and angle remain.
TEST(SlopeFiguresTest, WorkIsTheIntegralOfPower) {
  const v1::Model model = SampleModel();
  const SlopeFigures figures = MeasureSlope(SampleSolve("solves/a", 0));
  for (size_t a = 0; a < figures.joints.size(); ++a) {
    const int joint = static_cast<int>(a) + 3;
    double work = 0;  // ∮ τ dq along the closed forms
    constexpr int kSteps = 4000;
    const int which = (joint - 3) % 3;
    const double amplitude[] = {45, 30, 60};
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) * kStride_s / kSteps, half = 0.5 * kStride_s / kSteps;
      const double angle = 2 * M_PI * (t + (joint < 6 ? kSampleSpan_s : 0)) / kStride_s;
      const double torque = amplitude[which] * (std::sin(angle + which) + 0.4 * std::cos(2 * angle));
      work += torque * (SamplePosition(model, joint, t + half) - SamplePosition(model, joint, t - half));
    }
    const JointEffort& effort = figures.joints[a];
    EXPECT_NEAR(effort.positive_work - effort.negative_work, work, 0.01 * (effort.positive_work + effort.negative_work))
        << effort.joint;
  }
}

TEST(SlopeFiguresTest, PhasesAndEvents) {
  const SlopeFigures figures = MeasureSlope(SampleSolve("solves/a", 0));
  EXPECT_DOUBLE_EQ(figures.stride_time_s, kStride_s);
  EXPECT_DOUBLE_EQ(figures.stride_length_m, 2 * kSampleDisplacement_m);
  EXPECT_NEAR(figures.events.opposite_toe_off.value(), 10, 1e-9);
  EXPECT_NEAR(figures.events.opposite_heel_strike.value(), 50, 1e-9);
  EXPECT_NEAR(figures.events.toe_off.value(), 60, 1e-9);
  ASSERT_EQ(figures.phases.size(), 4u);
  EXPECT_EQ(figures.phases[0].feet, 2);
  EXPECT_EQ(figures.phases[1].feet, 1);
  EXPECT_NEAR(figures.phases[1].duration_s, 0.4 * kStride_s, 1e-12);
  EXPECT_THAT(figures.phases[1].contacts, testing::ElementsAre("right_foot"));
}

TEST(SlopeFiguresTest, WithoutAMotionThereAreNone) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->clear_trajectory();
  const SlopeFigures figures = MeasureSlope(solve);
  EXPECT_FALSE(figures.solved);
  EXPECT_TRUE(figures.phases.empty());
}

}  // namespace
}  // namespace rollgait::client
