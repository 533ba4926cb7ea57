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

// Row `row` of PackedRows::ToJson, decoded here by hand.
std::vector<double> Decode(const json& packed, int row) {
  const std::string text = packed["data"], digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  std::vector<double> values;
  const int columns = packed["columns"];
  for (int i = row * columns; i < (row + 1) * columns; ++i) {
    const auto low = static_cast<unsigned char>(bytes.at(2 * i)),
               high = static_cast<unsigned char>(bytes.at(2 * i + 1));
    const auto integer = static_cast<int16_t>(low | high << 8);
    values.push_back(integer == -32768 ? std::nan("") : integer * packed["scales"][row].get<double>());
  }
  return values;
}

TEST(ReportDataTest, CurvesOfEveryJointOfBothLegs) {
  const v1::Solve solve = SampleSolve("solves/a", 0.1);
  const json data = ReportData({solve}, "");
  const json& stride = data["solves"][0]["stride"];
  ASSERT_EQ(stride["joints"].size(), 7u);  // six of the legs and the trunk; no slides
  const v1::Model model = SampleModel();
  int found = 0;
  for (const json& joint : stride["joints"]) {
    for (int i = 0; i < model.joints_size(); ++i) {
      if (joint["name"] != model.joints(i).name()) continue;
      ++found;
      const std::vector<double> angles = Decode(stride["curves"], joint["angle"]);
      ASSERT_EQ(angles.size(), 201u);
      for (const int sample : {0, 50, 137}) {
        const double time = kSampleSpan_s + sample / 200.0 * 2 * kSampleSpan_s;
        EXPECT_NEAR(angles[sample], SamplePosition(model, i, time) * 180 / M_PI, 0.01) << joint["name"];
      }
      EXPECT_EQ(joint["torque"].is_null(), !model.joints(i).actuated());
    }
  }
  EXPECT_EQ(found, 7);
  EXPECT_EQ(stride["joints"][1]["title"], "hip");
  EXPECT_EQ(stride["joints"][1]["side"], 2);
  EXPECT_EQ(stride["joints"][0]["title"], "pelvis tilt");
}

TEST(ReportDataTest, IterationsAndNormativeDataAreThere) {
  v1::Solve solve = SampleSolve("solves/a", 0.1);
  v1::NormativeDatasetComparison& set = *solve.mutable_result()->mutable_normative()->add_datasets();
  set.set_name("people");
  set.add_curves()->add_mean(3.5);
  v1::Iteration iteration;
  iteration.set_index(7);
  iteration.set_objective(2.5);
  iteration.set_primal_infeasibility(1e-3);
  iteration.set_mesh(1);
  const json data = ReportData({ReportedSolve(solve, {iteration}), SampleSolve("solves/b", 0)}, "");
  EXPECT_EQ(data["datasets"][0]["curves"][0]["mean"], json({3.5}));
  // The data stand once on the page, not in every gait.
  EXPECT_FALSE(data["solves"][0]["people"]["datasets"][0]["curves"][0].contains("mean"));
  EXPECT_EQ(data["solves"][0]["log"][0], json({7, 1, 2.5, 1e-3, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(data["solves"][1]["log"].empty());
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
  EXPECT_EQ(stride["joints"].size(), 7u);
  EXPECT_TRUE(stride["scene"]["feet"].empty());
}

// Trajectories of direct multiple shooting are those of Hermite–Simpson.
TEST(ReportDataTest, TheSchemeIsTheOneThatWasAskedFor) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_spec()->mutable_discretization()->set_scheme(v1::Discretization::SCHEME_UNSPECIFIED);
  solve.mutable_result()->mutable_trajectory()->set_scheme(v1::Discretization::SCHEME_HERMITE_SIMPSON);
  EXPECT_EQ(ReportData({solve}, "")["solves"][0]["scheme"], "Hermite–Simpson");
  solve.mutable_spec()->mutable_discretization()->set_scheme(v1::Discretization::SCHEME_SHOOTING_CONSTANT);
  EXPECT_EQ(ReportData({solve}, "")["solves"][0]["scheme"], "direct multiple shooting, constant efforts");
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
  // The only address is the name of the SVG name space; three.js is packed.
  for (size_t at = rest.find("http:"); at != std::string::npos; at = rest.find("http:", at + 1)) {
    EXPECT_EQ(rest.substr(at, 26), "http://www.w3.org/2000/svg");
  }
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));  // nor may it ask for any
}

// The library stands in the page with its licence, and is less than a third of its 850 kB.
TEST(ReportTest, CarriesThreeJsAndItsLicence) {
  const std::string page = ReportHtml({SampleSolve("solves/a", 0)}, "");
  const std::string mark = "<script id=\"three\" type=\"text/plain\">";
  const size_t start = page.find(mark) + mark.size(), length = page.find("</script>", start) - start;
  EXPECT_EQ(page.substr(start, 4), "H4sI");  // gzip in base64
  EXPECT_GT(length, 100000u);
  EXPECT_LT(length, 283000u);
  EXPECT_THAT(page, HasSubstr("three.js authors"));
  EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
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
