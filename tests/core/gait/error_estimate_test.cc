// Estimated errors, and requests for an error.
#include "core/gait/error_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/gait/judge_solution.h"
#include "tests/core/gait/planar_errors.h"

namespace rollgait {
namespace {

// The estimate changes nothing of the answer, and its program is marked.
TEST(ErrorEstimate, LeavesTheAnswerAsItIs) {
  GaitRequest request = Planar(0, Preset::kTorque, 12);
  const GaitSolution with = SolvePlanar(request);
  request.accuracy.estimate_errors = false;
  const GaitSolution without = SolvePlanar(request);
  EXPECT_FALSE(without.errors);
  ASSERT_TRUE(with.errors) << with.message;
  EXPECT_EQ(with.objective, without.objective);
  EXPECT_EQ(with.trajectory->phases[0].point_positions, without.trajectory->phases[0].point_positions);
  ASSERT_EQ(with.meshes.size(), without.meshes.size() + 1);
  EXPECT_TRUE(with.meshes.back().for_errors);
  EXPECT_FALSE(with.meshes[with.meshes.size() - 2].for_errors);
  for (size_t p = 0; p < with.errors->finer_intervals.size(); ++p) {
    EXPECT_EQ(with.errors->finer_intervals[p], 2 * with.meshes[with.meshes.size() - 2].intervals[p]);
  }
  EXPECT_FALSE(with.errors->is_within_max_error);
  EXPECT_GT(with.errors->objective, 0);
  EXPECT_GT(with.errors->duration, 0);
  EXPECT_EQ(with.errors->phase_durations.size(), with.trajectory->phases.size());
}

TEST(MaxError, IsReachedByFinerMeshes) {
  GaitRequest request = Planar(0, Preset::kTorque, 8);
  const GaitSolution coarse = SolvePlanar(request);
  ASSERT_TRUE(coarse.errors);
  const double target = Largest(coarse.errors->motion, MotionQuantity::kAngle) / 10;
  request.accuracy.max_error = MaxError{.angle = target};
  const GaitSolution solution = SolvePlanar(request);
  ASSERT_TRUE(solution.errors) << solution.message;
  EXPECT_EQ(solution.errors->is_within_max_error, true) << solution.message;
  EXPECT_LE(Largest(solution.errors->motion, MotionQuantity::kAngle), target);
  EXPECT_GT(solution.meshes.size(), coarse.meshes.size());
}

TEST(MaxError, WhatIsNotReachedIsTold) {
  GaitRequest request = Planar(0, Preset::kTorque, 8);
  request.accuracy.max_error = MaxError{.torque = 1e-9};
  request.solver_limits.max_iterations = static_cast<int>(60);
  const GaitSolution solution = SolvePlanar(request);
  ASSERT_TRUE(Converged(solution.termination)) << solution.message;
  EXPECT_FALSE(solution.errors && *solution.errors->is_within_max_error);
  EXPECT_NE(solution.message.find("error"), std::string::npos) << solution.message;
}

// A stop in the program that is solved for the errors leaves a cancelled solve, not one that is done.
TEST(ErrorEstimate, AStopIsToldAsOne) {
  const GaitRequest request = Planar(0, Preset::kTorque, 12);
  GaitRequest plain = request;
  plain.accuracy.estimate_errors = false;
  const int last = static_cast<int>(SolvePlanar(plain).meshes.size()) - 1;
  StopFlag stop;
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    if (info.mesh > last) stop.Request();
  };
  const GaitSolution solution = SolvePlanar(request, control);
  EXPECT_EQ(solution.termination, Termination::kCancelled);
  EXPECT_FALSE(solution.errors);
}

// On another planet the search runs in another unit of time; errors are in seconds all the same.
TEST(ErrorEstimate, ScalesWithGravity) {
  GaitRequest earth = Planar(0, Preset::kTorque, 12), moon = earth;
  const double ratio = 1.62 / 9.81;
  moon.gravity = 1.62;
  moon.motion.speed = 1.3 * std::sqrt(ratio);
  const GaitSolution one = SolvePlanar(earth), two = SolvePlanar(moon);
  ASSERT_TRUE(one.errors && two.errors) << two.message;
  EXPECT_NEAR(Largest(two.errors->motion, MotionQuantity::kAngle) / Largest(one.errors->motion, MotionQuantity::kAngle),
              1, 1e-3);
  EXPECT_NEAR(Largest(two.errors->motion, MotionQuantity::kTorque) /
                  Largest(one.errors->motion, MotionQuantity::kTorque) / ratio,
              1, 1e-3);
  EXPECT_NEAR(two.errors->duration / one.errors->duration * std::sqrt(ratio), 1, 1e-2);
}

TEST(WorstShare, IsOfTheErrorsThatAreAskedFor) {
  ErrorEstimate errors;
  errors.objective = 0.01;
  errors.motion[static_cast<int>(MotionQuantity::kAngle)].largest = 0.02;
  errors.motion[static_cast<int>(MotionQuantity::kTorque)].largest = 3;
  errors.motion[static_cast<int>(MotionQuantity::kContactForce)].largest = 50;
  EXPECT_EQ(WorstShareOf({}, errors), 0);
  EXPECT_DOUBLE_EQ(WorstShareOf({.objective = 0.005}, errors), 2);
  EXPECT_DOUBLE_EQ(WorstShareOf({.angle = 0.04}, errors), 0.5);
  EXPECT_DOUBLE_EQ(WorstShareOf({.angle = 0.04, .torque = 1}, errors), 3);
  EXPECT_DOUBLE_EQ(WorstShareOf({.contact_force = 100}, errors), 0.5);
}

}  // namespace
}  // namespace rollgait
