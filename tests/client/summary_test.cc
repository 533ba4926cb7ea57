#include "client/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/sample_accuracy.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

// Beside the energy that was minimised stands the one without smoothing, where the two differ and the server told it.
TEST(SummaryTest, TellsTheEnergyWithoutSmoothing) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("without smoothing"))) << "equal";
  solve.mutable_result()->mutable_costs(0)->set_unsmoothed_value(612.25);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("without smoothing"));
  EXPECT_THAT(Summarize(solve, false), HasSubstr("612.25"));
  solve.mutable_result()->mutable_costs(0)->clear_unsmoothed_value();
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("without smoothing"))) << "of an older server";
}

// A flat foot of two surfaces is one foot: what the summary calls double support is what the message says.
TEST(SummaryTest, TellsEventsOfFeetNotOfSurfaces) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  v1::SolveResult& result = *solve.mutable_result();
  result.mutable_trajectory()->mutable_phases(1)->add_contacts("left_forefoot");
  result.mutable_gait_events()->set_double_support_fraction(0.21);
  v1::FootOnGround& stepping = *result.mutable_gait_events()->mutable_feet(0);
  stepping.set_step_length_m(0.725);
  stepping.set_step_duration_s(0.5125);
  stepping.set_loading_fraction(0.0625);
  result.mutable_gait_events()->set_step_length_asymmetry(-0.075);
  result.mutable_gait_events()->set_step_duration_asymmetry(3e-17);
  v1::GaitEvent& flat = *result.mutable_gait_events()->add_events();
  flat.set_kind(v1::GaitEvent::KIND_FOOT_FLAT);
  flat.set_foot(v1::FOOT_LEFT);
  flat.set_percent(57.5);
  const std::string text = Summarize(solve, false);
  EXPECT_THAT(text, HasSubstr("left_foot + left_forefoot"));
  EXPECT_THAT(text, testing::ContainsRegex("double support +21 %"));
  EXPECT_THAT(text, testing::ContainsRegex("step, right foot +0.725 m +0.5125 s, then 6.25 % on both feet"));
  EXPECT_THAT(text, testing::ContainsRegex("asymmetry, right less left +-7.5 % +of step length, 0 % of step duration"));
  EXPECT_THAT(text, testing::ContainsRegex("stance, right foot +60 % +heel strike 0, toe off 60\n"));
  EXPECT_THAT(text, HasSubstr("foot flat 57.5"));
}

TEST(SummaryTest, TellsWhichStepLengthItIs) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("\n  step length  +"));
  solve.mutable_result()->mutable_trajectory()->set_cycle(v1::CYCLE_FULL);
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("\n  step length, mean of both feet  +"));
}

TEST(SummaryTest, TellsTheVerdictAndEveryCriterion) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("\nAccuracy: within the requested bounds\n"));
  EXPECT_THAT(Summarize(solve, false),
              testing::ContainsRegex("slip of a contact that rolls +0.41  mm/s +≤ 1; left_foot at 0.31 s"));
  EXPECT_THAT(Summarize(solve, false),
              testing::ContainsRegex("joint past its range +0.0063  ° +≤ 0.05; knee_l at 0.31 s"));
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("over body weight +0.02  % of body weight +≤ 0.1"));
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("exceeds")));
  Exceed(solve, "max_range_excess", 3);
  Exceed(solve, "max_pull_bw", 12);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("\nAccuracy: EXCEEDED: normal force below its least value, over body "
                                                 "weight, 1.2 % of body weight where 0.1 % of "
                                                 "body weight is allowed (right_foot at 0.31 s)\n"));
  EXPECT_THAT(Summarize(solve, false),
              testing::ContainsRegex("joint past its range +0.15  ° +exceeds 0.05; knee_l at 0.31 s"));
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("within")));
}

TEST(SummaryTest, TellsEstimatedErrors) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("estimated error")));
  v1::ErrorEstimate& errors = *solve.mutable_result()->mutable_errors();
  errors.set_objective(0.0123);
  v1::QuantityError& angle = *errors.add_quantities();
  angle.set_quantity("joint angle");
  angle.set_unit("rad");
  angle.set_largest(0.01);
  angle.set_rms(0.002);
  angle.set_where("knee_l");
  angle.set_time_s(0.25);
  v1::QuantityError& unknown = *errors.add_quantities();
  unknown.set_quantity("warmth");
  unknown.set_unit("K");
  unknown.set_largest(7);
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("estimated error of the objective +1.23  %"));
  EXPECT_THAT(Summarize(solve, false),
              testing::ContainsRegex("estimated error of the joint angle +0.573  ° +knee_l at 0.25 s; RMS 0.115 °"));
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("estimated error of the warmth +7  K"));
  EXPECT_THAT(Summarize(solve, false), HasSubstr("\nAccuracy: within the requested bounds\n"));
  solve.mutable_spec()->mutable_accuracy()->mutable_max_error()->set_angle_rad(0.005);
  errors.set_within_max_error(false);
  EXPECT_THAT(Summarize(solve, false),
              HasSubstr("\nAccuracy: within the requested bounds; errors EXCEEDED: estimated error of the joint angle, "
                        "0.573 ° where 0.286 ° is allowed"));
  solve.mutable_spec()->mutable_accuracy()->mutable_max_error()->set_angle_rad(0.02);
  errors.set_within_max_error(true);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("within the requested bounds, within the requested errors\n"));
  solve.mutable_result()->clear_errors();
  EXPECT_THAT(Summarize(solve, false), HasSubstr("within the requested bounds; errors NOT ESTIMATED\n"));
}

TEST(SummaryTest, WhatWasNotJudgedIsNeverWithin) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->mutable_accuracy()->set_verdict(v1::VERDICT_NOT_JUDGED);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("Accuracy: not judged (draft)"));
  solve.mutable_result()->set_termination(v1::TERMINATION_TIME_LIMIT);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("Accuracy: not judged (the solver did not converge)"));
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("within")));
}

// Versions before 0.4.0 judged gap and slip alone and left no criteria.
TEST(SummaryTest, ShowsOlderResults) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->mutable_accuracy()->clear_criteria();
  solve.mutable_result()->mutable_accuracy()->clear_verdict();
  EXPECT_THAT(Summarize(solve, false), HasSubstr("Accuracy: not judged (a result of a version before 0.4.0)"));
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("largest slip +0.41  mm/s\n"));
}

// A server that is newer than this program.
TEST(SummaryTest, ShowsACriterionThatItDoesNotKnow) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  v1::CriterionResult& criterion = *solve.mutable_result()->mutable_accuracy()->add_criteria();
  criterion.set_criterion("max_noise_db");
  criterion.set_meaning("noise of the steps");
  criterion.set_unit("dB");
  criterion.set_value(41);
  EXPECT_THAT(Summarize(solve, false), testing::ContainsRegex("noise of the steps +41  dB\n"));
}

}  // namespace
}  // namespace rollgait::client
