// The grid of a sweep and its table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/sweep/grid.h"
#include "client/sweep/sweep_table.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SweepGridTest, RangesListsAndNumbers) {
  EXPECT_THAT(ParseSweepValues("--slope", "-10:10:5"), ElementsAre(-10, -5, 0, 5, 10));
  EXPECT_THAT(ParseSweepValues("--slope", "4:-4:-4"), ElementsAre(4, 0, -4));
  EXPECT_THAT(ParseSweepValues("--speed", "0.8:1.6:0.2"), ElementsAre(0.8, 1.0, 1.2, 1.4, 1.6)) << "1.6 is reached";
  EXPECT_THAT(ParseSweepValues("--speed", "0:1:0.3"), ElementsAre(0, 0.3, 0.6, 0.9)) << "1 is none of them";
  EXPECT_THAT(ParseSweepValues("--speed", "1.3,0.9"), ElementsAre(1.3, 0.9));
  EXPECT_THAT(ParseSweepValues("--speed", "1.3"), ElementsAre(1.3));
  EXPECT_THAT(ParseSweepValues("--speed", "1:1:1"), ElementsAre(1));
}

TEST(SweepGridTest, WhatIsNoGridIsRefusedWithItsFlag) {
  for (const char* text : {"", "a", "1,,2", "1,", "1:2", "1:2:0", "1:2:-1", "2:1:1", "1:2:3:4", "nan", "1:inf:1", "1,1",
                           "0:1000:1", "1 2"}) {
    try {
      ParseSweepValues("--speed", text);
      ADD_FAILURE() << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_THAT(failure.what(), HasSubstr(std::string("--speed ") + text + ": "));
    }
  }
  EXPECT_THROW(MakeGrid({"", "", "", ""}), Failure) << "no axis";
  EXPECT_NO_THROW(MakeGrid({"1:40:1", "1:25:1", "", ""}));
  EXPECT_THROW(MakeGrid({"1:40:1", "1:26:1", "", ""}), Failure) << "1040 points";
}

TEST(SweepGridTest, TheLastAxisChangesFastest) {
  const SweepGrid grid = MakeGrid({"-5,0", "0.8,1.2", "", ""});
  ASSERT_EQ(grid.axes.size(), 2u);
  EXPECT_EQ(grid.axes[1].column, "speed_m_s");
  std::vector<std::string> names;
  for (const SweepPoint& point : grid.points) names.push_back(point.name);
  EXPECT_THAT(names, ElementsAre("slope_-5_speed_0.8", "slope_-5_speed_1.2", "slope_0_speed_0.8", "slope_0_speed_1.2"));
  EXPECT_THAT(grid.points[1].values, ElementsAre(-5, 1.2));
}

class SweepTableTest : public testing::Test {
 protected:
  SweepTableTest() {
    v1::Solve failed;
    failed.set_name("solves/b");
    failed.set_state(v1::SOLVE_STATE_FAILED);
    failed.mutable_error()->set_message("died, \"three\" times");
    rows_ = {RowOf(SampleSolve("solves/a", 0.1)), RowOf(failed)};
  }
  const SweepGrid grid_ = MakeGrid({"5,6", "", "", ""});
  const v1::Solve sample_ = SampleSolve("solves/a", 0.1);
  std::vector<SweepRow> rows_;
};

TEST_F(SweepTableTest, RowsHaveWhatTheSolvesSay) {
  EXPECT_EQ(rows_[0].objective, sample_.result().objective());
  EXPECT_EQ(rows_[0].code, ExitCode::kSuccess);
  EXPECT_EQ(EndOf(rows_[0]), "optimal, within");
  EXPECT_EQ(rows_[1].code, ExitCode::kRunFailed);
  EXPECT_EQ(EndOf(rows_[1]), "failed: died, \"three\" times");
}

TEST_F(SweepTableTest, ForPeople) {
  const std::string text = SweepText(grid_, rows_);
  EXPECT_THAT(text, testing::ContainsRegex("slope_deg +solve +ended +accuracy +objective"));
  EXPECT_THAT(text, testing::ContainsRegex("5 +solves/a +optimal +within"));
  EXPECT_THAT(text, testing::ContainsRegex("6 +solves/b +failed +- +- +- +- +-"));
}

TEST_F(SweepTableTest, AsCommaSeparatedValues) {
  const std::string text = SweepCsv(grid_, rows_);
  EXPECT_THAT(text, testing::StartsWith("slope_deg,solve,state,termination,verdict,objective,found_speed_m_s,"
                                        "found_step_length_m,cpu_time_s,error\n5,solves/a,succeeded,optimal,within,"));
  EXPECT_THAT(text, testing::EndsWith("\n6,solves/b,failed,,,,,,,\"died, \"\"three\"\" times\"\n"));
}

TEST_F(SweepTableTest, AsJson) {
  const nlohmann::json data = SweepJson("hills", grid_, rows_);
  EXPECT_EQ(data.at("sweep"), "hills");
  EXPECT_EQ(data.at("points").at(0).at("slope_deg"), 5);
  EXPECT_EQ(data.at("points").at(0).at("objective"), sample_.result().objective());
  EXPECT_EQ(data.at("points").at(0).at("termination"), "TERMINATION_OPTIMAL");
  EXPECT_FALSE(data.at("points").at(1).contains("objective"));
  EXPECT_EQ(data.at("points").at(1).at("state"), "SOLVE_STATE_FAILED");
}

}  // namespace
}  // namespace rollgait::client
