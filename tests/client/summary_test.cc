#include "client/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  v1::GaitEvent& flat = *result.mutable_gait_events()->add_events();
  flat.set_kind(v1::GaitEvent::KIND_FOOT_FLAT);
  flat.set_foot(v1::FOOT_LEFT);
  flat.set_percent(57.5);
  const std::string text = Summarize(solve, false);
  EXPECT_THAT(text, HasSubstr("left_foot + left_forefoot"));
  EXPECT_THAT(text, testing::ContainsRegex("double support +21 %"));
  EXPECT_THAT(text, testing::ContainsRegex("stance, right foot +60 % +heel strike 0, toe off 60\n"));
  EXPECT_THAT(text, HasSubstr("foot flat 57.5"));
}

}  // namespace
}  // namespace rollgait::client
