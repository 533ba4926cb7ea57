#include "server/convert/normative_convert.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

NormativeComparison Comparison() {
  NormativeComparison people{};
  people.speed = 1;
  people.stride_time = 2;
  people.step_length = 3;
  people.cadence = 4;
  people.stance = 5;
  people.double_support = 6;
  people.opposite_toe_off = 7;
  people.toe_off = 8;
  people.peaks = {.first = 9, .second = 11, .valley = 10, .two = true};
  people.resting = {{"knee_r", true, 0.25}};
  DatasetComparison set{"set", "source", "between", 12, 13, 14, {15, std::nullopt, std::nullopt, false}, {}};
  set.curves.push_back({NormativeQuantity::kMoment, "hip", {16, 17}, {18, 19}, {20, 21}, {22, 23, 24}, 25, 26, 27, 28});
  people.datasets.push_back(set);
  return people;
}

TEST(EncodeNormative, EveryFigureOfTheCycleArrives) {
  const v1::NormativeComparison people = EncodeNormative(Comparison());
  EXPECT_EQ(people.speed_m_s(), 1);
  EXPECT_EQ(people.stride_time_s(), 2);
  EXPECT_EQ(people.step_length_m(), 3);
  EXPECT_EQ(people.cadence_per_min(), 4);
  EXPECT_EQ(people.stance_fraction(), 5);
  EXPECT_EQ(people.double_support_fraction(), 6);
  EXPECT_EQ(people.opposite_toe_off_percent(), 7);
  EXPECT_FALSE(people.has_opposite_heel_strike_percent());
  EXPECT_EQ(people.toe_off_percent(), 8);
  EXPECT_EQ(people.vertical_force().first_percent_bw(), 9);
  EXPECT_EQ(people.vertical_force().valley_percent_bw(), 10);
  EXPECT_EQ(people.vertical_force().second_percent_bw(), 11);
  EXPECT_TRUE(people.vertical_force().two_peaks());
  ASSERT_EQ(people.resting_joints_size(), 1);
  EXPECT_EQ(people.resting_joints(0).joint(), "knee_r");
  EXPECT_TRUE(people.resting_joints(0).at_max());
  EXPECT_EQ(people.resting_joints(0).stance_fraction(), 0.25);
}

TEST(EncodeNormative, EveryFigureOfACurveArrives) {
  const v1::NormativeComparison people = EncodeNormative(Comparison());
  ASSERT_EQ(people.datasets_size(), 1);
  const v1::NormativeDatasetComparison& set = people.datasets(0);
  EXPECT_EQ(set.name(), "set");
  EXPECT_EQ(set.source(), "source");
  EXPECT_EQ(set.deviation(), "between");
  EXPECT_EQ(set.speed_m_s(), 12);
  EXPECT_EQ(set.stride_time_s(), 13);
  EXPECT_EQ(set.stance_fraction(), 14);
  EXPECT_EQ(set.vertical_force().first_percent_bw(), 15);
  EXPECT_FALSE(set.vertical_force().has_valley_percent_bw());
  ASSERT_EQ(set.curves_size(), 1);
  const v1::NormativeCurve& curve = set.curves(0);
  EXPECT_EQ(curve.quantity(), v1::NormativeCurve::QUANTITY_MOMENT);
  EXPECT_EQ(curve.joint(), "hip");
  EXPECT_EQ(curve.ours(1), 17);
  EXPECT_EQ(curve.mean(0), 18);
  EXPECT_EQ(curve.deviation(1), 21);
  EXPECT_EQ(curve.rms(), 22);
  EXPECT_EQ(curve.rms_deviations(), 23);
  EXPECT_EQ(curve.correlation(), 24);
  EXPECT_EQ(curve.min(), 25);
  EXPECT_EQ(curve.max(), 26);
  EXPECT_EQ(curve.normative_min(), 27);
  EXPECT_EQ(curve.normative_max(), 28);
}

}  // namespace
}  // namespace rollgait::server
