#include "core/simulation/ground_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

GroundMotion RandomMotion(int seed) {
  std::mt19937 random(seed);
  const VectorX x = testing::RandomVector(random, 24);
  GroundMotion motion;
  motion.velocity = x.segment(0, 3), motion.acceleration = x.segment(3, 3), motion.amplitude = x.segment(6, 3);
  motion.frequency = std::abs(x[9]), motion.phase = x[10];
  motion.axis = Vector3(x.segment(11, 3)).normalized(), motion.pivot = x.segment(14, 3);
  motion.rate = x[17], motion.angular_acceleration = x[18], motion.swing = x[19];
  motion.swing_frequency = std::abs(x[20]), motion.swing_phase = x[21];
  return motion;
}

// Velocities and accelerations against differences of order 4 of the pose and of the velocities.
TEST(GroundMotion, RatesAreDerivativesOfThePose) {
  const double h = 1e-3;
  for (int seed = 1; seed <= 20; ++seed) {
    const GroundMotion motion = RandomMotion(seed);
    const double t = 0.1 * seed;
    const auto slope = [&](auto value) {
      return ((8 * (value(MotionAt(motion, t + h)) - value(MotionAt(motion, t - h))) -
               (value(MotionAt(motion, t + 2 * h)) - value(MotionAt(motion, t - 2 * h)))) /
              (12 * h))
          .eval();
    };
    const FrameMotion frame = MotionAt(motion, t);
    EXPECT_TRUE(MatrixNear(frame.v_WB, slope([](const FrameMotion& f) { return f.p_WB; }), 1e-7));
    EXPECT_TRUE(MatrixNear(frame.a_WB, slope([](const FrameMotion& f) { return f.v_WB; }), 1e-6));
    EXPECT_TRUE(MatrixNear(frame.alpha_WB, slope([](const FrameMotion& f) { return f.w_WB; }), 1e-6));
    const Matrix3 turning = slope([](const FrameMotion& f) { return f.R_WB; }) * frame.R_WB.transpose();
    EXPECT_TRUE(MatrixNear(frame.w_WB, Vector3(turning(2, 1), turning(0, 2), turning(1, 0)), 1e-7));
    EXPECT_GT(frame.a_WB.norm(), 0.1);
    EXPECT_FALSE(motion.IsFixed());
  }
}

TEST(GroundMotion, NothingMovesUnlessSaid) {
  const FrameMotion frame = MotionAt(GroundMotion{}, 12.5);
  EXPECT_TRUE(GroundMotion{}.IsFixed());
  EXPECT_TRUE(MatrixNear(frame.R_WB, Matrix3::Identity(), 0));
  EXPECT_TRUE(MatrixNear(frame.p_WB, Vector3::Zero(), 0));
  EXPECT_TRUE(MatrixNear(frame.v_WB, Vector3::Zero(), 0));
  EXPECT_TRUE(MatrixNear(frame.a_WB, Vector3::Zero(), 0));
}

// The pivot of a turntable stays where it is.
TEST(GroundMotion, ThePivotStandsStill) {
  GroundMotion motion;
  motion.rate = 3;
  motion.pivot = Vector3(1, 2, 0);
  const FrameMotion frame = MotionAt(motion, 0.7);
  EXPECT_TRUE(MatrixNear(frame.p_WB + frame.R_WB * motion.pivot, motion.pivot, 1e-15));
  EXPECT_TRUE(MatrixNear(frame.v_WB + frame.w_WB.cross(Vector3(frame.R_WB * motion.pivot)), Vector3::Zero(), 1e-14));
}

}  // namespace
}  // namespace rollgait
