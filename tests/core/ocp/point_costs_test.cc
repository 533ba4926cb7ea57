#include "core/ocp/costs/point_costs.h"

#include <gtest/gtest.h>

#include "tests/support/point_cost_check.h"

namespace rollgait {
namespace {

TEST(SquaredTorqueCost, WeighsSquares) {
  const PointLayout layout = SmallLayout();
  SquaredTorqueCost cost(Eigen::Vector2d(1, 3), layout, 100);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 2, -5;
  EXPECT_DOUBLE_EQ(ValueAt(cost, z), 4 + 75);
  CheckDerivatives(cost, layout);
}

TEST(MechanicalWorkCost, IsTheAbsolutePowerForLargePowers) {
  const PointLayout layout = SmallLayout();
  MechanicalWorkCost cost(0.5, {1, 2}, layout, 1);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 100, -100;
  z.segment(layout.v(), 3) << 7, 2, 3;  // the first coordinate is not actuated
  // √(p² + ε²) − ε = |p| − ε + ε²/(2|p|) …
  EXPECT_NEAR(ValueAt(cost, z), 200 + 300 - 2 * 0.5 + 0.125 / 200 + 0.125 / 300, 1e-6);
  EXPECT_DOUBLE_EQ(cost.Unsmoothed({z.data()}), 200 + 300);
  z.segment(layout.tau(), 2).setZero();
  EXPECT_EQ(ValueAt(cost, z), 0);
  CheckDerivatives(cost, layout);
}

TEST(TimeCost, IsOneEverywhere) {
  const PointLayout layout = SmallLayout();
  TimeCost cost;
  EXPECT_EQ(ValueAt(cost, RandomPoint(layout.size())), 1);
  CheckDerivatives(cost, layout);
}

}  // namespace
}  // namespace rollgait
