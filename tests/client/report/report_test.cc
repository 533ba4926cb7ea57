#include "client/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "client/report/report_data.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST(ReportDataTest, CurvesOfTheRightLeg) {
  const v1::Solve solve = SampleSolve("solves/a", 0.1);
  const json data = ReportData({solve}, "");
  const json& stride = data["solves"][0]["stride"];
  ASSERT_EQ(stride["torques"].size(), 3u);
  EXPECT_EQ(stride["torques"][1]["joint"], "knee_r");
  ASSERT_EQ(stride["angles"].size(), 4u);  // and the trunk
  EXPECT_EQ(stride["angles"][3]["joint"], "base_pitch");
  const v1::Model model = SampleModel();
  // 25 % of the cycle, knee_r, in degrees; five digits are kept.
  const double expected = SamplePosition(model, 7, kSampleSpan_s + 0.25 * 2 * kSampleSpan_s) * 180 / M_PI;
  EXPECT_NEAR(stride["angles"][1]["values"][50].get<double>(), expected, 0.01);
  EXPECT_EQ(stride["contacts"][1]["right"], true);
}

// Every figure of the page is that of the message, even where the message is wrong.
TEST(ReportDataTest, EventsAndForcesAreTheServers) {
  v1::Solve solve = SampleSolve("solves/a", 0.1);
  v1::GaitEvents& events = *solve.mutable_result()->mutable_gait_events();
  events.mutable_events(3)->set_percent(61.25);
  events.mutable_feet(0)->set_stance_fraction(0.6125);
  events.set_double_support_fraction(0.215);
  const json stride = ReportData({solve}, "")["solves"][0]["stride"];
  ASSERT_EQ(stride["events"].size(), 4u);
  EXPECT_EQ(stride["events"][3], json({{"percent", 61.25}, {"foot", "right"}, {"name", "toe off"}}));
  ASSERT_EQ(stride["phases"].size(), 4u);
  EXPECT_EQ(stride["phases"][0]["feet"], 2);
  EXPECT_EQ(stride["phases"][1]["contacts"], json({"right_foot"}));
  ASSERT_EQ(stride["feet"].size(), 2u);
  EXPECT_EQ(stride["feet"][0]["name"], "right foot");
  EXPECT_EQ(stride["feet"][0]["stance"], 0.6125);
  EXPECT_EQ(stride["feet"][0]["normal"][60], 100);  // % of body weight in single support
  EXPECT_NEAR(stride["feet"][0]["pressure"][80].get<double>(), 1e3 * 0.2 * (40 - 0.5) / 60,
              1e-3);  // loaded from 0.5 % on
  EXPECT_TRUE(stride["feet"][0]["pressure"][160].is_null());
  EXPECT_EQ(stride["double_support"], 0.215);
}

TEST(ReportDataTest, AnOlderServersResultHasNoEvents) {
  v1::Solve solve = SampleSolve("solves/a", 0.1);
  solve.mutable_result()->clear_gait_events();
  const json stride = ReportData({solve}, "")["solves"][0]["stride"];
  EXPECT_TRUE(stride["events"].empty());
  EXPECT_TRUE(stride["feet"].empty());
  EXPECT_TRUE(stride["double_support"].is_null());
  EXPECT_EQ(stride["torques"].size(), 3u);
}

TEST(ReportDataTest, WalkerHasLimbsOnItsSides) {
  const json data = ReportData({SampleSolve("solves/a", 0)}, "");
  const json& walker = data["solves"][0]["stride"]["walker"];
  // Nine joints, the end of the trunk, two feet.
  EXPECT_EQ(walker["points"][0].size(), 2u * 12);
  int trunk = 0, right = 0, left = 0;
  for (const json& segment : walker["segments"]) {
    (segment[2] == 0 ? trunk : segment[2] == 1 ? right : left)++;
  }
  EXPECT_EQ(trunk, 3);  // to both hips and up
  EXPECT_EQ(right, 3);  // thigh, shank, foot
  EXPECT_EQ(left, 3);
  // The trunk's end is twice as far from the hips as its mass centre.
  const json& first = walker["points"][0];
  const double dx = first[18].get<double>() - first[4].get<double>();
  const double dz = first[19].get<double>() - first[5].get<double>();
  EXPECT_NEAR(std::hypot(dx, dz), 0.64, 3e-4);
}

TEST(ReportDataTest, LabelsTellSolvesApart) {
  const json data = ReportData({SampleSolve("solves/a", -0.17453292519943295), SampleSolve("solves/b", 0)}, "");
  EXPECT_EQ(data["solves"][0]["label"], "−10°");
  EXPECT_EQ(data["solves"][1]["label"], "0°");
  v1::Solve slow = SampleSolve("solves/b", 0);
  slow.mutable_result()->set_speed_m_s(0.9);
  const json speeds = ReportData({SampleSolve("solves/a", 0), slow}, "");
  EXPECT_EQ(speeds["solves"][1]["label"], "0°, 0.9 m/s");
  const json same = ReportData({SampleSolve("solves/a", 0), SampleSolve("solves/b", 0)}, "");
  EXPECT_EQ(same["solves"][1]["label"], "0°, 1.3 m/s, solves/b");
}

TEST(ReportTest, OneFileWithoutTheNetwork) {
  const std::string page = ReportHtml({SampleSolve("solves/a", 0), SampleSolve("solves/b", 0.1)}, "");
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  std::string rest = page;
  // The only address is the name of the SVG name space.
  for (size_t at = rest.find("http"); at != std::string::npos; at = rest.find("http", at + 1)) {
    EXPECT_EQ(rest.substr(at, 26), "http://www.w3.org/2000/svg");
  }
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
}

TEST(ReportTest, TextCannotBecomeMarkup) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->set_message("</script><script>alert(1)</script> {{style}}");
  const std::string page = ReportHtml({solve}, "a <b> & {{data}}");
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cscript>alert(1)"));
  EXPECT_THAT(page, HasSubstr("<title>a &lt;b&gt; &amp; "));
}

TEST(ReportTest, ASolveWithoutTrajectoryIsReportedToo) {
  v1::Solve failed;
  failed.set_name("solves/f");
  failed.set_state(v1::SOLVE_STATE_FAILED);
  failed.mutable_error()->set_kind(v1::SolveError::KIND_CRASH);
  const json data = ReportData({failed}, "");
  EXPECT_TRUE(data["solves"][0]["stride"].is_null());
  EXPECT_EQ(data["solves"][0]["good"], false);
  EXPECT_THAT(ReportHtml({failed}, ""), HasSubstr("failed (crash)"));
}

TEST(ReportTest, RefusesATrajectoryOfAnotherModel) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->mutable_model()->mutable_joints()->RemoveLast();
  EXPECT_THROW(ReportHtml({solve}, ""), Failure);
}

}  // namespace
}  // namespace rollgait::client
