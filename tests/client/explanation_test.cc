#include "client/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/limit_use.h"
#include "tests/client/sample_accuracy.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

v1::Joint& JointOf(v1::Solve& solve, const std::string& name) {
  for (v1::Joint& joint : *solve.mutable_result()->mutable_model()->mutable_joints()) {
    if (joint.name() == name) return joint;
  }
  throw std::logic_error("no joint " + name);
}

// The largest and smallest value of a joint over the points of the trajectory.
std::pair<double, double> Span(const v1::Solve& solve, const std::string& name) {
  const v1::Trajectory& trajectory = solve.result().trajectory();
  int column = 0;
  while (trajectory.joint_names(column) != name) ++column;
  std::pair<double, double> span{1e9, -1e9};
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    for (int row = 0; row < phase.point_positions().rows(); ++row) {
      const double value = phase.point_positions().values(row * phase.point_positions().columns() + column);
      span = {std::min(span.first, value), std::max(span.second, value)};
    }
  }
  return span;
}

const LimitUse* FindUse(const std::vector<LimitUse>& uses, LimitKind kind, const std::string& where) {
  for (const LimitUse& use : uses) {
    if (use.kind == kind && use.where == where) return &use;
  }
  return nullptr;
}

TEST(LimitUseTest, FindsAJointOnItsRangeAndNoOther) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  EXPECT_EQ(FindUse(FindLimitUse(solve), LimitKind::kPosition, "knee_l"), nullptr);
  const auto [least, most] = Span(solve, "knee_l");
  // The upper limit cuts off the top tenth of what the knee does: a part of the points, not all.
  JointOf(solve, "knee_l").set_position_max(most - 0.1 * (most - least));
  const std::vector<LimitUse> uses = FindLimitUse(solve);
  const LimitUse* const use = FindUse(uses, LimitKind::kPosition, "knee_l");
  ASSERT_NE(use, nullptr);
  EXPECT_THAT(use->limit, HasSubstr("upper limit of "));
  EXPECT_THAT(use->limit, HasSubstr("°"));
  EXPECT_GT(use->share, 0);
  EXPECT_LT(use->share, 1);
  EXPECT_EQ(FindUse(uses, LimitKind::kPosition, "knee_r"), nullptr);
}

TEST(LimitUseTest, AJointBeyondBothEndsOfTheMotionIsAlwaysOnIt) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  JointOf(solve, "hip_r").set_position_min(Span(solve, "hip_r").second);
  const std::vector<LimitUse> uses = FindLimitUse(solve);
  const LimitUse* const use = FindUse(uses, LimitKind::kPosition, "hip_r");
  ASSERT_NE(use, nullptr);
  EXPECT_NEAR(use->share, 1, 1e-9);
  EXPECT_EQ(&uses.front(), use);
}

TEST(LimitUseTest, FindsFriction) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  solve.mutable_spec()->mutable_ground_contact()->set_friction_coefficient(0.5);
  for (v1::TrajectoryPhase& phase : *solve.mutable_result()->mutable_trajectory()->mutable_phases()) {
    v1::Matrix& forces = *phase.mutable_point_forces();
    for (int i = 0; i < forces.values_size(); ++i) forces.set_values(i, i % 3 == 0 ? 0.5 * 700 : i % 3 == 1 ? 0 : 700);
  }
  solve.mutable_result()->mutable_model()->set_total_mass_kg(75);
  solve.mutable_result()->mutable_model()->set_gravity_m_s2(9.81);
  const std::vector<LimitUse> uses = FindLimitUse(solve);
  const LimitUse* const use = FindUse(uses, LimitKind::kFriction, "left_foot");
  ASSERT_NE(use, nullptr);
  EXPECT_NEAR(use->share, 1, 1e-9);
  solve.mutable_spec()->mutable_ground_contact()->set_friction_coefficient(0.51);
  EXPECT_EQ(FindUse(FindLimitUse(solve), LimitKind::kFriction, "left_foot"), nullptr);
}

TEST(LimitUseTest, NothingWithoutATrajectoryThatFits) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  solve.mutable_result()->mutable_trajectory()->set_joint_names(0, "tail");
  EXPECT_TRUE(FindLimitUse(solve).empty());
  EXPECT_TRUE(FindLimitUse(v1::Solve()).empty());
}

TEST(ExplanationTest, AnOptimumSaysSoAndHowItWasReached) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  solve.mutable_result()->mutable_multipliers()->add_bounds(1);
  solve.mutable_result()->mutable_multipliers()->add_bounds(1e-6f);
  const std::string text = Explain(solve, {});
  EXPECT_THAT(text, HasSubstr("solves/s\n\nHow it ended\n  The solver found a local optimum"));
  EXPECT_THAT(text, HasSubstr("Active bounds: 1 of 2 unknowns of the last program"));
  EXPECT_THAT(text, HasSubstr("How the iterations went\n"));
  EXPECT_THAT(text, HasSubstr("Program 1, 8 + 16 intervals: 41 iterations"));
  EXPECT_THAT(text, Not(HasSubstr("What is not met")));
}

TEST(ExplanationTest, AnInfeasibleSolveNamesConstraintsAndRemedies) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  solve.mutable_result()->set_termination(v1::TERMINATION_INFEASIBLE);
  v1::UnmetConstraint& unmet = *solve.mutable_result()->add_unmet_constraints();
  unmet.set_name("friction on average");
  unmet.set_violation(0.1263);
  unmet.set_unit("1");
  for (const double violation : {0.1, 0.05}) {
    v1::UnmetConstraint& rolling = *solve.mutable_result()->add_unmet_constraints();
    rolling.set_name("rolling left_foot x");
    rolling.set_violation(violation);
    rolling.set_unit("m/s");
  }
  solve.mutable_result()->mutable_multipliers()->add_bounds(1);
  const std::string text = Explain(solve, {});
  EXPECT_THAT(
      text,
      HasSubstr("\"rolling left_foot x\" is missed by 0.1 m/s in phase 0 at 0 s, and by less at 1 other instant."));
  EXPECT_THAT(text, Not(HasSubstr("0.05")));
  EXPECT_THAT(text, Not(HasSubstr("Active bounds")));
  EXPECT_THAT(text, HasSubstr("found no motion that meets every constraint"));
  EXPECT_THAT(text, HasSubstr("\"friction on average\" is missed by 0.126 in phase 0"));
  EXPECT_THAT(text, HasSubstr("Raise --friction"));
}

TEST(ExplanationTest, AnExceededBoundSaysWhatToAskFor) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  Exceed(solve, "max_slip_m_s", 20);
  const std::string text = Explain(solve, {});
  EXPECT_THAT(text, HasSubstr("What is not met"));
  EXPECT_THAT(text, HasSubstr("--max-refinements"));
  EXPECT_THAT(text, HasSubstr("--bound max_slip_m_s="));
}

TEST(ExplanationTest, LimitsOfTheSolverSayWhichFlagRaisesThem) {
  v1::Solve solve = SampleSolve("solves/s", 0);
  solve.mutable_result()->set_termination(v1::TERMINATION_ITERATION_LIMIT);
  EXPECT_THAT(Explain(solve, {}), HasSubstr("Raise --max-iterations"));
  solve.mutable_result()->set_termination(v1::TERMINATION_TIME_LIMIT);
  EXPECT_THAT(Explain(solve, {}), HasSubstr("Raise --max-time"));
}

TEST(ExplanationTest, TheLogTellsOfDifficulties) {
  const v1::Solve solve = SampleSolve("solves/s", 0);
  std::vector<v1::Iteration> log(4);
  for (v1::Iteration& iteration : log) iteration.set_primal_step(1);
  EXPECT_THAT(Explain(solve, log), Not(HasSubstr("iterations in the log")));
  log[0].set_primal_step(0);  // the first line of a mesh
  log[1].set_primal_step(0.05);
  log[1].set_regularization(1e-4);
  log[2].set_regularization(1e-4);
  log[3].set_restoration(true);
  const std::string text = Explain(solve, log);
  EXPECT_THAT(text, HasSubstr("In 1 of the 4 iterations in the log less than a tenth of the step could be taken."));
  EXPECT_THAT(text, HasSubstr("In 2 of the 4 iterations in the log the problem had to be made convex"));
  EXPECT_THAT(text, HasSubstr("In 1 of the 4 iterations in the log the solver sought feasibility alone"));
}

TEST(ExplanationTest, ARunWithoutAnAnswerSaysWhy) {
  v1::Solve solve;
  solve.set_name("solves/s");
  solve.set_state(v1::SOLVE_STATE_FAILED);
  solve.mutable_error()->set_kind(v1::SolveError::KIND_MEMORY_LIMIT);
  solve.mutable_error()->set_message("it took more than 2 GiB");
  const std::string text = Explain(solve, {});
  EXPECT_THAT(text, HasSubstr("It failed without an answer (memory limit): it took more than 2 GiB"));
  EXPECT_THAT(text, HasSubstr("fewer --intervals"));
  EXPECT_THAT(text, Not(HasSubstr("limits\n")));
}

}  // namespace
}  // namespace rollgait::client
