#include "client/program_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>

#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

v1::Solve SolveOnASlope() {
  v1::Solve solve = SampleSolve("solves/s", 5);
  solve.mutable_result()->clear_meshes();
  return solve;
}

v1::MeshStatistics& Add(v1::Solve* solve, v1::ProgramStart start, v1::Termination termination) {
  v1::MeshStatistics& program = *solve->mutable_result()->add_meshes();
  program.set_start(start);
  program.set_termination(termination);
  program.set_slope_rad(solve->spec().slope_rad());
  program.add_intervals(4);
  program.add_intervals(8);
  program.set_iterations(7);
  return program;
}

TEST(ProgramLogTest, EachProgramSaysWhatItWasAndHowItEnded) {
  v1::Solve solve = SolveOnASlope();
  solve.mutable_result()->mutable_trajectory()->set_cycle(v1::CYCLE_FULL);
  v1::MeshStatistics& first = Add(&solve, v1::PROGRAM_START_GUESS, v1::TERMINATION_ITERATION_LIMIT);
  first.set_half_cycle(true);
  first.set_sides_alike(true);
  first.set_slope_rad(0);
  first.set_smoothing_w(40);
  Add(&solve, v1::PROGRAM_START_COARSER_MESH, v1::TERMINATION_OPTIMAL);
  EXPECT_THAT(
      ProgramSentences(solve),
      ElementsAre(StartsWith("Program 1, from a guess, one step with its mirror image, the body with both sides alike, "
                             "on a slope of 0°, powers smoothed by 40 W, 4 + 8 intervals: iteration limit after 7 "
                             "iterations, "),
                  StartsWith("Program 2, from the solution on the mesh before, 4 + 8 intervals: optimal after 7 ")));
}

// Each of what a program adds to the request is said by itself.
TEST(ProgramLogTest, WhatIsAddedIsSaidAlone) {
  const std::pair<void (*)(v1::MeshStatistics*), const char*> kAdded[] = {
      {[](v1::MeshStatistics*) {}, ""},
      {[](v1::MeshStatistics* program) { program->set_half_cycle(true); }, ", one step with its mirror image"},
      {[](v1::MeshStatistics* program) { program->set_sides_alike(true); }, ", the body with both sides alike"},
      {[](v1::MeshStatistics* program) { program->set_added_torque_rates(true); }, ", with a price of torque rates"},
      {[](v1::MeshStatistics* program) { program->set_smoothing_w(3); }, ", powers smoothed by 3 W"},
      {[](v1::MeshStatistics* program) { program->set_for_errors(true); }, ", to estimate the errors"},
  };
  for (const auto& [add, words] : kAdded) {
    v1::Solve solve = SolveOnASlope();
    solve.mutable_result()->mutable_trajectory()->set_cycle(v1::CYCLE_FULL);
    v1::MeshStatistics& program = Add(&solve, v1::PROGRAM_START_GUESS, v1::TERMINATION_OPTIMAL);
    add(&program);
    EXPECT_EQ(ProgramWords(solve, program), std::string("from a guess") + words);
  }
}

TEST(ProgramLogTest, WhatIsAsRequestedIsNotSaid) {
  v1::Solve solve = SolveOnASlope();
  solve.mutable_result()->mutable_trajectory()->set_cycle(v1::CYCLE_HALF);
  v1::MeshStatistics& program = Add(&solve, v1::PROGRAM_START_OTHER_REQUEST, v1::TERMINATION_OPTIMAL);
  program.set_half_cycle(true);
  EXPECT_EQ(ProgramWords(solve, program), "from the warm start");
}

TEST(ProgramLogTest, AResultOfAnOlderVersionHasItsMeshesAlone) {
  v1::Solve solve = SolveOnASlope();
  v1::MeshStatistics& program = Add(&solve, v1::PROGRAM_START_UNSPECIFIED, v1::TERMINATION_UNSPECIFIED);
  program.set_slope_rad(0);
  EXPECT_THAT(ProgramSentences(solve), ElementsAre(StartsWith("Program 1, 4 + 8 intervals: 7 iterations, ")));
}

}  // namespace
}  // namespace rollgait::client
