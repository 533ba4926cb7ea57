// The points of a trade-off, the true errors and the front.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/failure.h"
#include "client/spec_words.h"
#include "client/text.h"
#include "client/tradeoff/points.h"
#include "client/tradeoff/solve_row.h"
#include "client/tradeoff/true_errors.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

TEST(TradeoffPointsTest, AllCombinationsTheLastAxisFastest) {
  const auto points = MakeTradeoffPoints("radau3,radau2", "4,8", "1e-4,1e-6");
  ASSERT_EQ(points.size(), 8u);
  EXPECT_EQ(points[1].scheme, "radau3");
  EXPECT_EQ(points[1].intervals, 4);
  EXPECT_EQ(points[1].tolerance, 1e-6);
  EXPECT_EQ(points[7].scheme, "radau2");
  EXPECT_EQ(points[7].intervals, 8);
  EXPECT_GT(OrderOf("radau3"), OrderOf("hermite-simpson"));
  // Of constant efforts no mesh is a reference for a scheme with free ones.
  EXPECT_EQ(OrderOf("shooting-constant"), 2);
  for (const auto& [word, scheme] : SchemeWords()) {
    if (word != "shooting-constant") EXPECT_GE(OrderOf(word), 3) << word;
  }
  EXPECT_GT(OrderOf("hermite-simpson"), OrderOf("radau2"));
}

TEST(TradeoffPointsTest, WhatIsOutsideIsRefusedWithFlagAndLimit) {
  const auto why = [](const std::string& schemes, const std::string& intervals, const std::string& tolerances) {
    try {
      MakeTradeoffPoints(schemes, intervals, tolerances);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      return std::string(failure.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(why("radau2", "250", "1e-12"), "accepted");
  EXPECT_THAT(why("euler", "8", "1e-6"), HasSubstr("--scheme euler: \"euler\" must be one of hermite-simpson, "
                                                   "lobatto4, lobatto5, radau2, radau3, radau4, radau5"));
  EXPECT_THAT(why("radau2,radau2", "8", "1e-6"), HasSubstr("--scheme"));
  EXPECT_THAT(why("radau2,", "8", "1e-6"), HasSubstr("--scheme"));
  EXPECT_THAT(why("radau2", "251", "1e-6"), HasSubstr("--intervals 251: 251 must be a whole number in [1, 250]"));
  EXPECT_THAT(why("radau2", "2.5", "1e-6"), HasSubstr("--intervals"));
  EXPECT_THAT(why("radau2", "8", "0.02"), HasSubstr("--tolerance 0.02: 0.02 must be in [1e-12, 1e-2]"));
  EXPECT_THAT(why("radau2,radau3", "1:101:1", "1e-6"), HasSubstr("202 points, the most are 200"));
}

TEST(TradeoffPointsTest, ARequestHasExactlyTheMeshOfItsPoint) {
  v1::SolveSpec task;
  task.mutable_discretization()->set_double_support_intervals(3);
  task.mutable_accuracy()->set_estimate_errors(true);
  task.mutable_accuracy()->mutable_max_error();
  const v1::SolveSpec spec = SpecOfPoint(task, {"radau3", 12, 1e-5});
  EXPECT_EQ(spec.discretization().scheme(), v1::Discretization::SCHEME_RADAU3);
  EXPECT_EQ(spec.discretization().single_support_intervals(), 12);
  EXPECT_FALSE(spec.discretization().has_double_support_intervals());
  EXPECT_EQ(spec.accuracy().kkt_tolerance(), 1e-5);
  EXPECT_TRUE(spec.accuracy().has_max_refinements());
  EXPECT_EQ(spec.accuracy().max_refinements(), 0);
  EXPECT_FALSE(spec.accuracy().estimate_errors());
  EXPECT_FALSE(spec.accuracy().has_max_error());
  task.set_warm_start("nearest");
  EXPECT_THROW(SpecOfPoint(task, {"radau3", 12, 1e-5}), Failure);
}

TEST(TradeoffErrorsTest, LargestDifferencesOfAnglesAndTorques) {
  const v1::Solve sample = SampleSolve("solves/a", 0);
  v1::SolveResult other = sample.result();
  const TrueErrors none = ErrorsAgainst(sample.result(), other);
  EXPECT_EQ(none.objective, 0);
  EXPECT_EQ(none.angle_deg, 0);
  EXPECT_EQ(none.torque_n_m, 0);
  // One joint of the second phase is off by 0.02 rad, another by less; the place of the walker does not count.
  v1::Matrix& positions = *other.mutable_trajectory()->mutable_phases(1)->mutable_node_positions();
  for (int row = 0; row < positions.rows(); ++row) {
    positions.set_values(row * positions.columns(), positions.values(row * positions.columns()) + 1);
    positions.set_values(row * positions.columns() + 4, positions.values(row * positions.columns() + 4) - 0.02);
    positions.set_values(row * positions.columns() + 5, positions.values(row * positions.columns() + 5) + 0.01);
  }
  v1::Matrix& efforts = *other.mutable_trajectory()->mutable_phases(0)->mutable_point_efforts();
  for (int row = 0; row < efforts.rows(); ++row) {
    efforts.set_values(row * efforts.columns() + 2, efforts.values(row * efforts.columns() + 2) - 3);
  }
  other.set_objective(sample.result().objective() * 0.99);
  const TrueErrors errors = ErrorsAgainst(sample.result(), other);
  EXPECT_NEAR(errors.angle_deg, 0.02 * 180 / kPi, 1e-9);
  EXPECT_NEAR(errors.torque_n_m, 3, 1e-9);
  EXPECT_NEAR(errors.objective, 0.01, 1e-12);
}

TEST(TradeoffErrorsTest, OtherPhasesAreRefused) {
  const v1::Solve sample = SampleSolve("solves/a", 0);
  v1::SolveResult other = sample.result();
  other.mutable_trajectory()->mutable_phases()->RemoveLast();
  EXPECT_THROW(ErrorsAgainst(sample.result(), other), Failure);
}

TEST(TradeoffMinimumTest, AnotherOneKeepsMostOfTheError) {
  EXPECT_EQ(MinimumOf(0.9, std::nullopt), Minimum::kSame) << "too near to be another one";
  EXPECT_EQ(MinimumOf(1.1, std::nullopt), Minimum::kUnknown);
  EXPECT_EQ(MinimumOf(8, 3.9), Minimum::kSame);
  EXPECT_EQ(MinimumOf(8, 4.1), Minimum::kOther);
  EXPECT_TRUE(IsWellKnown(0.4, 0.19));
  EXPECT_FALSE(IsWellKnown(0.4, 0.21));
}

SolveRow RowAt(double cpu_time_s, double angle_deg) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  solve.mutable_result()->set_cpu_time_s(cpu_time_s);
  SolveRow row = RowOfPoint({"radau2", 8, 1e-6}, solve);
  row.errors = TrueErrors{0.001, angle_deg, 2.0};
  row.minimum = Minimum::kSame;
  return row;
}

std::vector<bool> FrontOf(const std::vector<SolveRow>& rows) {
  std::vector<bool> marks;
  for (const nlohmann::json& row : SolveTable("n", "", rows).rows) marks.push_back(row.at("on_front"));
  return marks;
}

TEST(TradeoffFrontTest, WhatNoOtherBeatsInTimeAndError) {
  EXPECT_THAT(FrontOf({RowAt(1, 0.5), RowAt(2, 0.1), RowAt(2, 0.2), RowAt(3, 0.1), RowAt(1.5, 0.3)}),
              testing::ElementsAre(true, true, false, false, true));
  EXPECT_THAT(FrontOf({RowAt(1, 0.5), RowAt(1, 0.5)}), testing::ElementsAre(true, true)) << "equals do not beat";
}

TEST(TradeoffFrontTest, AnotherMinimumAndWhatHasNoErrorIsNotOnItAndBeatsNothing) {
  SolveRow other = RowAt(0.1, 0.01), unknown = other, without = other;
  other.minimum = Minimum::kOther;
  unknown.minimum = Minimum::kUnknown;
  without.errors.reset();
  EXPECT_THAT(FrontOf({other, unknown, without, RowAt(1, 0.5)}), testing::ElementsAre(false, false, false, true));
}

class TradeoffTableTest : public testing::Test {
 protected:
  TradeoffTableTest() {
    v1::Solve failed;
    failed.set_name("solves/b");
    failed.set_state(v1::SOLVE_STATE_FAILED);
    failed.mutable_error()->set_message("died");
    rows_ = {RowAt(1, 0.5), RowOfPoint({"radau3", 4, 1e-8}, failed)};
    rows_[0].is_well_known = true;
  }
  std::vector<SolveRow> rows_;
};

TEST_F(TradeoffTableTest, RowsAreShort) {
  EXPECT_FALSE(rows_[0].solve.result().has_trajectory());
  EXPECT_TRUE(rows_[0].is_optimal);
  EXPECT_EQ(rows_[0].iterations, 41 + 21);
  EXPECT_FALSE(rows_[1].is_optimal);
  EXPECT_FALSE(rows_[1].solve.has_result());
}

TEST_F(TradeoffTableTest, ForPeople) {
  EXPECT_THAT(TradeoffText(SolveTable("n", "", rows_)),
              testing::ContainsRegex("\\* +radau2 +8 +1e-06 +optimal +same +1 +62 +812.5 +0.1 "
                                     "+0.5 +2 +- +- +-"));
  EXPECT_THAT(TradeoffText(SolveTable("n", "", rows_)), testing::ContainsRegex("radau3 +4 +1e-08 +failed +- +- +-"));
  rows_[0].is_well_known = false;
  EXPECT_THAT(TradeoffText(SolveTable("n", "", rows_)), HasSubstr("?0.5"));
}

TEST_F(TradeoffTableTest, AsCommaSeparatedValues) {
  const std::string text = TradeoffCsv(SolveTable("n", "", rows_));
  EXPECT_THAT(text, testing::StartsWith("scheme,intervals,tolerance,solve,ended,from_cache,minimum,well_known,on_front,"
                                        "cpu_time_s,iterations,objective,objective_error,angle_error_deg,"));
  EXPECT_THAT(text, HasSubstr("\nradau2,8,1e-06,solves/a,optimal,0,same,1,1,1,62,812.5,0.001,0.5,2,,,\n"));
  EXPECT_THAT(text, testing::EndsWith("\nradau3,4,1e-08,solves/b,failed,0,,,0,,,,,,,,,\n"));
}

TEST_F(TradeoffTableTest, AsJson) {
  const nlohmann::json data = TradeoffJson(SolveTable("n", "solves/r", rows_));
  EXPECT_EQ(data.at("reference"), "solves/r");
  EXPECT_EQ(data.at("points").at(0).at("angle_error_deg"), 0.5);
  EXPECT_EQ(data.at("points").at(0).at("on_front"), true);
  EXPECT_EQ(data.at("points").at(1).at("error"), "died");
  EXPECT_FALSE(data.at("points").at(1).contains("angle_error_deg"));
  EXPECT_FALSE(TradeoffJson(SolveTable("n", "", rows_)).contains("reference"));
}

TEST_F(TradeoffTableTest, TheServicesEstimateInDegrees) {
  v1::SolveResult result;
  EXPECT_FALSE(EstimateOf(result).has_value());
  result.mutable_errors()->set_objective(0.02);
  v1::QuantityError& angle = *result.mutable_errors()->add_quantities();
  angle.set_quantity("joint angle");
  angle.set_largest(kPi / 180);
  v1::QuantityError& torque = *result.mutable_errors()->add_quantities();
  torque.set_quantity("joint torque");
  torque.set_largest(4);
  const auto estimate = EstimateOf(result);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_EQ(estimate->objective, 0.02);
  EXPECT_NEAR(estimate->angle_deg, 1, 1e-12);
  EXPECT_EQ(estimate->torque_n_m, 4);
}

}  // namespace
}  // namespace rollgait::client
