#include "client/predict/predict_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/gait/default_speed.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

v1::SolveSpec Spec(double slope_deg, double speed_m_s) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_preset(v1::PRESET_HUMAN);
  spec.set_slope_rad(slope_deg * kDegree);
  spec.mutable_motion()->set_speed_m_s(speed_m_s);
  return spec;
}

// Times at four corners, and one of another level that is far off.
std::vector<MeasuredTime> Corners(double a, double b, double c, double d) {
  constexpr v1::Accuracy::Level kStandard = v1::Accuracy::LEVEL_STANDARD;
  return {{"planar", v1::PRESET_HUMAN, kStandard, -4, 1.1, a},
          {"planar", v1::PRESET_HUMAN, kStandard, 4, 1.1, b},
          {"planar", v1::PRESET_HUMAN, kStandard, -4, 1.5, c},
          {"planar", v1::PRESET_HUMAN, kStandard, 4, 1.5, d},
          {"planar", v1::PRESET_HUMAN, v1::Accuracy::LEVEL_FINE, 0, 1.3, 1000}};
}

TEST(PredictTimeTest, IsTheMeanOfWhatIsAsNear) {
  const PredictedTime time = PredictTime(Spec(0, 1.3), Corners(1, 4, 1, 4));
  ASSERT_TRUE(time.cpu_s) << time.reason;
  EXPECT_NEAR(*time.cpu_s, 2, 1e-9) << "of logarithms";
  EXPECT_EQ(time.solves, 4);
  EXPECT_NEAR(time.low_s * time.high_s, 4, 1e-9);
  EXPECT_GT(time.high_s, 2.5) << "each corner is badly predicted by the others";
  v1::SolveSpec same = Spec(0, 1.3);
  same.clear_motion();
  same.mutable_accuracy()->set_level(v1::Accuracy::LEVEL_STANDARD);
  same.set_cycle(v1::CYCLE_HALF);
  EXPECT_NEAR(PredictTime(same, Corners(1, 4, 1, 4)).cpu_s.value(), 2, 1e-9) << "which says the defaults";
}

TEST(PredictTimeTest, KnowsTheSpeedOfARequestWithoutOne) {
  const std::vector<MeasuredTime> corners = Corners(1, 1, 10, 10);
  v1::SolveSpec spec = Spec(0, DefaultSpeed(kDefaultGravity));
  const double with = PredictTime(spec, corners).cpu_s.value();
  spec.clear_motion();
  EXPECT_EQ(PredictTime(spec, corners).cpu_s, with);
  EXPECT_NE(PredictTime(Spec(0, 1.29), corners).cpu_s, with);
}

TEST(PredictTimeTest, FollowsWhatIsNear) {
  const PredictedTime time = PredictTime(Spec(3.9, 1.49), Corners(1, 1, 1, 10));
  ASSERT_TRUE(time.cpu_s) << time.reason;
  EXPECT_GT(*time.cpu_s, 8);
  EXPECT_LT(*time.cpu_s, 10);
  const PredictedTime flat = PredictTime(Spec(1, 1.2), Corners(3, 3, 3, 3));
  EXPECT_NEAR(*flat.cpu_s, 3, 1e-9);
  EXPECT_NEAR(flat.high_s, 3, 1e-9);
}

TEST(PredictTimeTest, SaysWhatNoMeasurementIsNear) {
  const auto reason = [](const std::function<void(v1::SolveSpec&)>& change) {
    v1::SolveSpec spec = Spec(0, 1.3);
    change(spec);
    const PredictedTime time = PredictTime(spec, Corners(1, 4, 1, 4));
    EXPECT_FALSE(time.cpu_s);
    return time.reason;
  };
  EXPECT_THAT(reason([](auto& spec) { spec.set_slope_rad(5 * kDegree); }), HasSubstr("slope"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_motion()->set_speed_m_s(1); }), HasSubstr("speed"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_model()->set_name("human29"); }), HasSubstr("model"));
  EXPECT_THAT(reason([](auto& spec) { spec.clear_preset(); }), HasSubstr("preset"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_accuracy()->set_level(v1::Accuracy::LEVEL_FINE); }),
              HasSubstr("level"));
  EXPECT_THAT(reason([](auto& spec) { spec.set_cycle(v1::CYCLE_FULL); }), HasSubstr("cycle"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_accuracy()->mutable_max_error()->set_objective(0.1); }),
              HasSubstr("accuracy.max_error.objective"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_discretization()->set_single_support_intervals(64); }),
              HasSubstr("discretization"));
  EXPECT_THAT(reason([](auto& spec) { spec.add_costs()->mutable_time(); }), HasSubstr("costs"));
  EXPECT_THAT(reason([](auto& spec) { spec.mutable_motion()->set_free_speed(true); }), HasSubstr("motion.free_speed"));
}

// The table is what the program answers from.
TEST(PredictTimeTest, TheTableAnswersForEachOfItsKinds) {
  ASSERT_GE(MeasuredTimes().size(), 100u);
  for (const MeasuredTime& measured : MeasuredTimes()) {
    EXPECT_GT(measured.cpu_s, 0);
    v1::SolveSpec spec = Spec(measured.slope_deg, measured.speed_m_s);
    spec.mutable_model()->set_name(measured.model);
    spec.set_preset(measured.preset);
    spec.mutable_accuracy()->set_level(measured.level);
    const PredictedTime time = PredictTime(spec, MeasuredTimes());
    ASSERT_TRUE(time.cpu_s) << time.reason;
    EXPECT_LE(time.low_s, *time.cpu_s);
    EXPECT_GE(time.high_s, *time.cpu_s);
  }
  EXPECT_THAT(SourceOfMeasuredTimes(), HasSubstr("solve_times"));
}

}  // namespace
}  // namespace rollgait::client
