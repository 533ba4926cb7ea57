#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "tests/support/ball_request.h"

namespace rollgait {
namespace {

using testing::HasSubstr;

struct Case {
  const char* name;
  std::function<void(GaitRequest&)> spoil;
  const char* field;
  const char* words;
};

class RefusedManoeuvre : public ::testing::TestWithParam<Case> {};

TEST_P(RefusedManoeuvre, NamesFieldValueAndLimit) {
  GaitRequest request = RollTo(1, 0, 2);
  ASSERT_TRUE(CheckRequest(request).ok());
  GetParam().spoil(request);
  const Result<GaitSpec> spec = CheckRequest(request);
  ASSERT_FALSE(spec.ok());
  ASSERT_EQ(spec.violations().size(), 1u) << spec.violations()[1].field << " " << spec.violations()[1].message;
  EXPECT_EQ(spec.violations()[0].field, GetParam().field);
  EXPECT_THAT(spec.violations()[0].message, HasSubstr(GetParam().words));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Cases, RefusedManoeuvre,
    ::testing::Values(
        Case{"zero_duration", [](GaitRequest& r) { r.manoeuvre->duration = 0; }, "manoeuvre.duration_s", "0.01"},
        Case{"long_duration", [](GaitRequest& r) { r.manoeuvre->duration = 101; }, "manoeuvre.duration_s", "100"},
        Case{"free_duration_without_cost", [](GaitRequest& r) { r.manoeuvre->duration.reset(); },
             "manoeuvre.duration_s", "time cost"},
        Case{"errors", [](GaitRequest& r) { r.accuracy.estimate_errors = true; }, "accuracy.estimate_errors",
             "only those of gaits"},
        Case{"max_error", [](GaitRequest& r) { r.accuracy.max_error = MaxError{.angle = 0.1}; }, "accuracy.max_error",
             "only those of gaits"},
        Case{"nan", [](GaitRequest& r) { r.manoeuvre->end.x = kNan; }, "manoeuvre.end.x_m", "finite"},
        Case{"far", [](GaitRequest& r) { r.manoeuvre->end.x = 20.1; }, "manoeuvre.end", "at most 20 m"},
        Case{"not_unit", [](GaitRequest& r) { r.manoeuvre->end.orientation = Eigen::Vector4d(1, 0, 0, 0.01); },
             "manoeuvre.end.orientation", "unit quaternion"},
        Case{"zero_quaternion", [](GaitRequest& r) { r.manoeuvre->start.orientation = Eigen::Vector4d::Zero(); },
             "manoeuvre.start.orientation", "has length 0"},
        Case{"fast", [](GaitRequest& r) { r.manoeuvre->start.angular_velocity.y() = 1001; },
             "manoeuvre.start.angular_velocity_rad_s.y", "1000"},
        Case{"velocity_without_orientation", [](GaitRequest& r) { r.manoeuvre->end.angular_velocity.z() = 1; },
             "manoeuvre.end.angular_velocity_rad_s", "give the orientation too"},
        Case{"speed", [](GaitRequest& r) { r.motion.speed = 1; }, "motion", "contradicts manoeuvre"},
        Case{"cycle", [](GaitRequest& r) { r.cycle = Cycle::kHalf; }, "cycle", "nothing is repeated"},
        Case{"touch_down", [](GaitRequest& r) { r.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic; },
             "ground_contact.touch_down", "nothing touches down"},
        Case{"phases", [](GaitRequest& r) { r.phases.emplace(); }, "phases", "one phase"},
        Case{"per_distance", [](GaitRequest& r) { r.normalization = GaitRequest::Normalization::kPerDistance; },
             "cost_normalization", "may be zero"},
        Case{"work",
             [](GaitRequest& r) {
               r.costs = {{cost::MechanicalWork{}, {}}};
             },
             "costs[0]", "squared_torque or time"},
        Case{"chart_limit",
             [](GaitRequest& r) {
               r.limits.joint_position["roll_2"] = {-1, 1};
             },
             "limits.joint_position[\"roll_2\"]", "chart"},
        Case{"walker", [](GaitRequest& r) { r.body.model = "planar"; }, "manoeuvre", "\"ball\" so far"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(ManoeuvreRequest, IsRequiredByTheBallAndByItsCycle) {
  GaitRequest request = RollTo(1, 0, 2);
  request.manoeuvre.reset();
  Result<GaitSpec> spec = CheckRequest(request);
  ASSERT_FALSE(spec.ok());
  EXPECT_EQ(spec.violations()[0].field, "manoeuvre");
  request = {};
  request.body.model = "planar";
  request.cycle = Cycle::kOnce;
  spec = CheckRequest(request);
  ASSERT_FALSE(spec.ok());
  EXPECT_EQ(spec.violations()[0].field, "cycle");
}

TEST(ManoeuvreRequest, DefaultsAreFilledIn) {
  GaitRequest request = RollTo(0, 0, 2);  // end equal to start is a manoeuvre
  request.manoeuvre->end.x.reset();
  const GaitSpec spec = CheckRequest(request).value();
  ASSERT_TRUE(spec.manoeuvre);
  EXPECT_EQ(spec.manoeuvre->start.x, 0);
  EXPECT_EQ(spec.manoeuvre->start.y, 0);
  EXPECT_TRUE(spec.manoeuvre->start.orientation->isApprox(Eigen::Quaterniond::Identity(), 0));
  EXPECT_FALSE(spec.manoeuvre->end.x);
  EXPECT_EQ(spec.manoeuvre->end.y, 0);
  EXPECT_FALSE(spec.manoeuvre->end.orientation);
  ASSERT_EQ(spec.phases.size(), 1u);
  EXPECT_EQ(spec.phases[0].intervals, 24);
  EXPECT_EQ(spec.phases[0].min_duration, 2);
  EXPECT_EQ(spec.max_iterations, 5000);
}

}  // namespace
}  // namespace rollgait
