#include "core/validation/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rollgait {
namespace {

TEST(ObserveOrder, PowerLaw) {
  std::vector<MeshError> meshes;
  for (double h : {0.1, 0.05, 0.02, 0.01}) meshes.push_back({h, 7 * std::pow(h, 3.5)});
  const auto order = ObserveOrder(meshes);
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(order->order, 3.5, 1e-12);
  ASSERT_EQ(order->between_meshes.size(), 3u);
  for (double slope : order->between_meshes) EXPECT_NEAR(slope, 3.5, 1e-12);
}

TEST(ObserveOrder, SlopesBetweenMeshesShowWhereConvergenceStops) {
  const auto order = ObserveOrder({{0.4, 1e-2}, {0.2, 1.25e-3}, {0.1, 1.25e-3}});
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(order->between_meshes[0], 3, 1e-12);
  EXPECT_NEAR(order->between_meshes[1], 0, 1e-12);
  EXPECT_NEAR(order->order, 1.5, 1e-12);
}

TEST(ObserveOrder, NothingToTell) {
  EXPECT_FALSE(ObserveOrder({}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}, {0.1, 0.5}}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}, {0.05, 0}}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}, {-0.05, 1}}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}, {0.05, std::numeric_limits<double>::infinity()}}).has_value());
  EXPECT_FALSE(ObserveOrder({{0.1, 1}, {0.05, std::numeric_limits<double>::quiet_NaN()}}).has_value());
}

}  // namespace
}  // namespace rollgait
