#include "core/ocp/costs/body_torque.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/models/rolling_ellipsoid.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

// z of a rolling body: three slides, three angles; three efforts, three forces.
constexpr int kSize = 24, kBeta = 4, kTau = 18;
const PointLayout kLayout{6, 3, 3};

BodyTorqueCost Cost() { return BodyTorqueCost(kBeta, kLayout, 1); }

double ValueAt(const VectorX& z) {
  BodyTorqueCost cost = Cost();
  PointContext at;
  at.z = z.data();
  return cost.Value(at);
}

VectorX GradientAt(const VectorX& z, double weight) {
  BodyTorqueCost cost = Cost();
  PointContext at;
  at.z = z.data();
  VectorX gradient = VectorX::Zero(kSize);
  cost.AddGradient(at, weight, gradient);
  return gradient;
}

VectorX RandomPoint(SeededRandom* random) {
  VectorX z = random->VectorOf(kSize, -1, 1);
  z(kBeta) *= OrientationChart::kLargestTilt;
  return z;
}

// Second derivation: the couple from the efforts by the joint axes of a chart, whatever its constant rotations are.
TEST(BodyTorqueTest, IsTheSquareOfTheCoupleInEveryChart) {
  SeededRandom random(5);
  for (int k = 0; k < 100; ++k) {
    const OrientationChart chart{Eigen::Quaterniond(Eigen::AngleAxisd(k, random.Unit())).toRotationMatrix(),
                                 Eigen::Quaterniond(Eigen::AngleAxisd(2 * k, random.Unit())).toRotationMatrix()};
    VectorX z = RandomPoint(&random);
    const Vector3 couple = random.Vector(-3, 3);
    z.segment<3>(kTau) = ChartRates(chart, z.segment<3>(3)).transpose() * couple;
    EXPECT_NEAR(ValueAt(z), couple.squaredNorm(), 1e-12);  // cos²β > 0.07
  }
}

TEST(BodyTorqueTest, DerivativesAreThoseOfDifferences) {
  SeededRandom random(6);
  constexpr double kStep = 1e-5, kWeight = 1.7;
  for (int k = 0; k < 20; ++k) {
    const VectorX z = RandomPoint(&random);
    VectorX gradient(kSize);
    MatrixX hessian(kSize, kSize);
    for (int i = 0; i < kSize; ++i) {
      const VectorX ahead = z + kStep * VectorX::Unit(kSize, i), behind = z - kStep * VectorX::Unit(kSize, i);
      gradient(i) = kWeight * (ValueAt(ahead) - ValueAt(behind)) / (2 * kStep);
      hessian.col(i) = (GradientAt(ahead, kWeight) - GradientAt(behind, kWeight)) / (2 * kStep);
    }
    // Differences: step² times third derivatives, which reach 1e3 near the edge of the chart.
    EXPECT_TRUE(MatrixNear(GradientAt(z, kWeight), gradient, 1e-6));
    BodyTorqueCost cost = Cost();
    PointContext at;
    at.z = z.data();
    MatrixX added = MatrixX::Zero(kSize, kSize);
    cost.AddHessian(at, kWeight, added);
    // Blocks (α, β) with α before β in (q, …, τ, …), diagonal blocks in full.
    MatrixX expected = hessian;
    expected.block(kTau, 0, 3, kTau).setZero();
    EXPECT_TRUE(MatrixNear(added, expected, 1e-5));
    EXPECT_GT(expected.norm(), 1);
    // Nothing outside the declared pattern.
    for (const auto& [row, column] : cost.HessianPattern()) added(row, column) = added(column, row) = 0;
    EXPECT_EQ(added.norm(), 0);
  }
}

}  // namespace
}  // namespace rollgait
