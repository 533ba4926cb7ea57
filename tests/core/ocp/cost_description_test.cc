#include "core/ocp/cost_description.h"

#include <gtest/gtest.h>

#include "core/ocp/costs/point_costs.h"

namespace rollgait {
namespace {

TEST(CostDescription, SpeaksForItsIntegrand) {
  CostDescription cost;
  cost.term = std::make_unique<TimeCost>();
  ASSERT_NE(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Typical(), 1);
  EXPECT_FALSE(cost.IsRateOf(RateCost::Of::kEfforts));
}

TEST(CostDescription, RatesHaveNoIntegrand) {
  CostDescription cost;
  cost.term = RateCost{RateCost::Of::kForces, {}, 90.0};
  EXPECT_EQ(cost.integrand(), nullptr);
  EXPECT_EQ(cost.Typical(), 90);
  EXPECT_TRUE(cost.IsRateOf(RateCost::Of::kForces));
  EXPECT_FALSE(cost.IsRateOf(RateCost::Of::kEfforts));
}

TEST(CostDescription, TrackingSumsTheWeightsOfItsChannels) {
  CostDescription cost;
  cost.term = TrackingCost{{{0, 2.0, CubicSpline({0, 1})}, {1, 3.0, CubicSpline({0, 1})}}};
  EXPECT_EQ(cost.integrand(), nullptr);
  EXPECT_DOUBLE_EQ(cost.Typical(), 0.05);
}

}  // namespace
}  // namespace rollgait
