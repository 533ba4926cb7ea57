#include "client/normative_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/report/report_data.h"
#include "client/summary.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

v1::NormativeComparison People() {
  v1::NormativeComparison people;
  people.set_stance_fraction(0.612);
  people.set_cadence_per_min(112);
  people.mutable_vertical_force()->set_first_percent_bw(109);
  auto* const resting = people.add_resting_joints();
  resting->set_joint("knee_r");
  resting->set_stance_fraction(0.75);
  people.add_resting_joints()->set_joint("ankle_r");  // for a moment only
  auto* const set = people.add_datasets();
  set->set_name("somebody");
  for (const auto quantity : {v1::NormativeCurve::QUANTITY_ANGLE, v1::NormativeCurve::QUANTITY_VERTICAL_FORCE}) {
    auto* const curve = set->add_curves();
    curve->set_quantity(quantity);
    curve->set_joint(quantity == v1::NormativeCurve::QUANTITY_ANGLE ? "hip" : "foot");
    curve->set_correlation(0.931);
    curve->set_rms(4.5);
    curve->set_rms_deviations(1.25);
  }
  return people;
}

TEST(NormativeTableTest, SummaryHasTheFigures) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("beside normative gait")));
  *solve.mutable_result()->mutable_normative() = People();
  const std::string text = Summarize(solve, false);
  EXPECT_THAT(text, HasSubstr("Right leg beside normative gait (level ground)"));
  EXPECT_THAT(text, HasSubstr("61.2 %"));
  EXPECT_THAT(text, HasSubstr("109 / - / - %"));
  EXPECT_THAT(text, HasSubstr("knee_r (lower, 75 %)"));
  EXPECT_THAT(text, Not(HasSubstr("ankle_r (")));
  EXPECT_THAT(text, HasSubstr("correlation 0.93"));
  EXPECT_THAT(text, HasSubstr("1.25 SD"));
  EXPECT_THAT(text, Not(HasSubstr("foot angle")));
  EXPECT_THAT(text, Not(HasSubstr("Left leg"))) << "it is the mirror image";
}

TEST(NormativeTableTest, BothLegsOfABodyWhoseSidesDiffer) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  *solve.mutable_result()->mutable_normative() = People();
  *solve.mutable_result()->mutable_normative_left() = People();
  solve.mutable_result()->mutable_normative_left()->set_stance_fraction(0.587);
  const std::string text = Summarize(solve, false);
  const size_t left = text.find("\nLeft leg beside normative gait (level ground)\n");
  ASSERT_NE(left, std::string::npos);
  EXPECT_THAT(text.substr(0, left), HasSubstr("61.2 %"));
  EXPECT_THAT(text.substr(left), HasSubstr("58.7 %"));
  const nlohmann::json data = ReportData({solve}, "")["solves"][0];
  EXPECT_EQ(data["people_left"]["stanceFraction"], 0.587);
  EXPECT_EQ(data["people_left"]["datasets"][0]["curves"][0]["joint"], "hip");
}

TEST(NormativeTableTest, ReportGetsTheCurves) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_TRUE(ReportData({solve}, "")["solves"][0]["people"].is_null());
  EXPECT_TRUE(ReportData({solve}, "")["solves"][0]["people_left"].is_null());
  *solve.mutable_result()->mutable_normative() = People();
  const nlohmann::json people = ReportData({solve}, "")["solves"][0]["people"];
  EXPECT_EQ(people["datasets"][0]["curves"][0]["joint"], "hip");
  EXPECT_EQ(people["datasets"][0]["curves"][0]["correlation"], 0.931);
}

}  // namespace
}  // namespace rollgait::client
