#include "core/ocp/cost_description.h"

#include <gtest/gtest.h>

#include "core/ocp/costs/point_costs.h"

namespace rollgait {
namespace {

TEST(CostDescription, SpeaksForItsIntegrand) {
  CostDescription cost;
  cost.term = std::make_unique<TimeCost>();
  ASSERT_NE(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Name(), "time");
  EXPECT_EQ(cost.Unit(), "s");
  EXPECT_EQ(cost.Typical(), 1);
}

TEST(CostDescription, EffortRateHasNoIntegrand) {
  CostDescription cost;
  cost.term = EffortRateCost{Eigen::Vector2d(1, 2), 90.0};
  EXPECT_EQ(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Name(), "squared torque rate");
  EXPECT_EQ(cost.Unit(), "N² m²/s");
  EXPECT_DOUBLE_EQ(cost.Typical(), 3 * 300.0 * 300.0);
}

TEST(CostDescription, ForceRateHasNoIntegrand) {
  CostDescription cost;
  cost.term = ForceRateCost{700.0};
  EXPECT_EQ(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Name(), "squared force rate");
  EXPECT_EQ(cost.Unit(), "N²/s");
  EXPECT_DOUBLE_EQ(cost.Typical(), 3500.0 * 3500.0);
}

TEST(CostDescription, TrackingSumsTheWeightsOfItsChannels) {
  CostDescription cost;
  cost.term = TrackingCost{{{0, 2.0, CubicSpline({0, 1})}, {1, 3.0, CubicSpline({0, 1})}}};
  EXPECT_EQ(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Name(), "tracking");
  EXPECT_EQ(cost.Unit(), "rad² s");
  EXPECT_DOUBLE_EQ(cost.Typical(), 0.05);
}

}  // namespace
}  // namespace rollgait
