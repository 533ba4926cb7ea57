// Where flat sides of friction pyramids cost something, edges are added, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/gait/added_constraints.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The force of each side that costs more than its share of the objective gets an edge, once, if it is inside the side.
TEST(AddFrictionEdges, WhereASideCostsMoreThanItsShare) {
  const std::vector<FlatSide> sides = {{1, 0, {0, 9}, 0.011, 16 * kDegree},    // 3 · 5°
                                       {1, 0, {9, 18}, 0.009, 70 * kDegree},   // costs too little
                                       {1, 2, {63, 72}, 0.5, 341 * kDegree},   // 68 · 5°
                                       {1, 2, {18, 27}, 0.5, 91 * kDegree},    // next to an edge
                                       {1, 2, {63, 72}, 0.5, 359 * kDegree}};  // likewise
  AddedConstraints added;
  EXPECT_TRUE(AddFrictionEdges(sides, -10, 1e-3, &added));
  ASSERT_EQ(added.between.size(), 2u);
  EXPECT_TRUE(added.between[0].friction.empty());
  EXPECT_EQ(added.between[1].friction, (std::vector<FrictionEdge>{{0, 3}, {2, 68}}));
  EXPECT_FALSE(AddFrictionEdges(sides, -10, 1e-3, &added));
  EXPECT_EQ(added.between[1].friction.size(), 2u);
  EXPECT_TRUE(AddFrictionEdges(sides, -10, 5e-4, &added));
  EXPECT_EQ(added.between[1].friction, (std::vector<FrictionEdge>{{0, 3}, {0, 14}, {2, 68}}));
}

}  // namespace
}  // namespace rollgait
