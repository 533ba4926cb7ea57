#include "core/ocp/costs/muscle_costs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/point_cost_check.h"

namespace rollgait {
namespace {

// Two muscled joints on coordinates 1 and 2, with springs of gentle curvature so that differences stay exact to 1e-7.
std::vector<MuscledJoint> TwoJoints() {
  return {{1, 2.0, 0.7, {0.3, {{{0.4, -0.5}, {-0.2, 0.6}}}}}, {2, 3.0, 1.3, {-0.1, {{{0.3, -0.4}}}}}};
}

std::vector<MuscledJoint> WithoutSprings() { return {{1, 2.0, 0.7, {}}, {2, 3.0, 1.3, {}}}; }

TEST(MuscleEffortCost, IsThePowerOfTheActivity) {
  const PointLayout layout = SmallLayout();
  MuscleEffortCost cost(WithoutSprings(), 3, layout);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 4, -6;
  EXPECT_DOUBLE_EQ(ValueAt(cost, z), 0.7 * 8 + 1.3 * 8);
}

TEST(MuscleEffortCost, TheSpringsTorqueIsFree) {
  const PointLayout layout = SmallLayout();
  MuscleEffortCost cost(TwoJoints(), 2, layout);
  VectorX z = RandomPoint(layout.size());
  for (int j = 0; j < 2; ++j) {
    const double q = z(1 + j);
    z(layout.tau() + j) =
        j == 0 ? 0.3 + 0.4 * std::exp(-0.5 * q) - 0.2 * std::exp(0.6 * q) : -0.1 + 0.3 * std::exp(-0.4 * q);
  }
  EXPECT_NEAR(ValueAt(cost, z), 0, 1e-30);
}

TEST(MuscleEffortCost, DerivativesMeetDifferences) {
  const PointLayout layout = SmallLayout();
  for (const double exponent : {2.0, 3.0, 4.5}) {
    MuscleEffortCost cost(TwoJoints(), exponent, layout);
    CheckDerivatives(cost, layout);
  }
}

TEST(MuscleWorkCost, PaysForBothDirectionsByTheirEfficiency) {
  const PointLayout layout = SmallLayout();
  MuscleWorkCost cost(WithoutSprings(), 0.25, 1.25, 1e-6, layout, 1);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 5, -5;
  z.segment(layout.v(), 3) << 9, 2, 3;                                     // the first coordinate has no muscle
  EXPECT_NEAR(ValueAt(cost, z), 0.7 * 10 / 0.25 + 1.3 * 15 / 1.25, 1e-4);  // 1e-6 of smoothing and rounding of ε²
  EXPECT_DOUBLE_EQ(cost.Unsmoothed({z.data()}), 0.7 * 10 / 0.25 + 1.3 * 15 / 1.25);
}

// Muscles that are stretched slowly are not paid for it (a newcomer's walk downhill once "took" -37 J).
TEST(MuscleWorkCost, IsNeverAnIncome) {
  const PointLayout layout = SmallLayout();
  MuscleWorkCost cost(TwoJoints(), 0.25, 1.2, 20, layout, 1);
  VectorX z = RandomPoint(layout.size());
  for (double rate = -30; rate <= 30; rate += 0.37) {
    z.segment(layout.v(), 3) << 1, rate, -rate / 2;
    EXPECT_GE(ValueAt(cost, z), 0) << rate;
  }
}

TEST(MuscleWorkCost, DerivativesMeetDifferences) {
  const PointLayout layout = SmallLayout();
  MuscleWorkCost cost(TwoJoints(), 0.25, 1.2, 0.8, layout, 1);
  CheckDerivatives(cost, layout);
}

TEST(PassiveLoadCost, IsTheSquareOfTheSpringsTorque) {
  const PointLayout layout = SmallLayout();
  PassiveLoadCost cost(TwoJoints(), layout);
  const VectorX z = VectorX::Zero(layout.size());
  EXPECT_NEAR(ValueAt(cost, z), 0.7 * std::pow(0.5 / 2, 2) + 1.3 * std::pow(0.2 / 3, 2), 1e-15);
  CheckDerivatives(cost, layout);
}

TEST(SquaredAccelerationCost, WeighsSquares) {
  const PointLayout layout = SmallLayout();
  SquaredAccelerationCost cost(Eigen::Vector3d(0, 2, 3), layout);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.a(), 3) << 7, -2, 3;
  EXPECT_DOUBLE_EQ(ValueAt(cost, z), 8 + 27);
  CheckDerivatives(cost, layout);
}

}  // namespace
}  // namespace rollgait
