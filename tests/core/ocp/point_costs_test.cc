#include "core/ocp/costs/point_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <set>

namespace rollgait {
namespace {

// Three coordinates, the last two actuated, one force.
PointLayout SmallLayout() {
  PointLayout layout;
  layout.n = 3;
  layout.efforts = 2;
  layout.forces = 1;
  return layout;
}

VectorX RandomPoint(int size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2, 2);
  VectorX z(size);
  for (double& value : z) value = uniform(random);
  return z;
}

double ValueAt(PointCost& cost, const VectorX& z) { return cost.Value({z.data()}); }

// Gradient and Hessian against central differences (truncation 1e-10 of derivatives of order one), and the pattern against the
// Hessian: every entry that is not zero is announced, in the triangle that is delivered.
void CheckDerivatives(PointCost& cost, const PointLayout& layout) {
  const VectorX z = RandomPoint(layout.size());
  const double step = 1e-5, weight = 1.7;
  const auto gradient_at = [&](const VectorX& at) {
    VectorX gradient = VectorX::Zero(at.size());
    cost.AddGradient({at.data()}, weight, gradient);
    return gradient;
  };
  MatrixX hessian = MatrixX::Zero(z.size(), z.size());
  cost.AddHessian({z.data()}, weight, hessian);
  const Entries entries = cost.HessianPattern();
  const std::set<std::pair<int, int>> pattern(entries.begin(), entries.end());
  for (int i = 0; i < z.size(); ++i) {
    VectorX up = z, down = z;
    up(i) += step;
    down(i) -= step;
    EXPECT_NEAR(gradient_at(z)(i), weight * (ValueAt(cost, up) - ValueAt(cost, down)) / (2 * step), 1e-7) << i;
    const VectorX column = (gradient_at(up) - gradient_at(down)) / (2 * step);
    for (int j = 0; j <= i; ++j) {
      EXPECT_NEAR(hessian(j, i), column(j), 1e-7) << j << " " << i;
      if (hessian(j, i) != 0) {
        EXPECT_EQ(pattern.count({j, i}), 1u) << j << " " << i;
      }
    }
  }
}

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
