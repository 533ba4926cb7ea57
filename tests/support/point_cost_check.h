#ifndef ROLLGAIT_TESTS_SUPPORT_POINT_COST_CHECK_H_
#define ROLLGAIT_TESTS_SUPPORT_POINT_COST_CHECK_H_

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

#include "core/ocp/point_function.h"

namespace rollgait {

// Three coordinates, the last two actuated, one force.
inline PointLayout SmallLayout() {
  PointLayout layout;
  layout.n = 3;
  layout.efforts = 2;
  layout.forces = 1;
  return layout;
}

inline VectorX RandomPoint(int size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2, 2);
  VectorX z(size);
  for (double& value : z) value = uniform(random);
  return z;
}

inline double ValueAt(PointCost& cost, const VectorX& z) { return cost.Value({z.data()}); }

// Gradient and Hessian against central differences (truncation 1e-10 of derivatives of order one), and the pattern
// against the Hessian: every entry that is not zero is announced, in the triangle that is delivered.
inline void CheckDerivatives(PointCost& cost, const PointLayout& layout) {
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

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_POINT_COST_CHECK_H_
