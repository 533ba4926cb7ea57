#include "core/nlp/newton_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/nlp/nlp_options.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

// A point of HS071 near two of its bounds, away from its constraints, with its linearisation.
class NewtonStepTest : public ::testing::Test {
 protected:
  NewtonStepTest() : barrier_(problem_, NlpOptions().BoundRelaxation()), newton_(barrier_, {}) {
    EXPECT_TRUE(barrier_.MakeInterior(Eigen::Vector4d(1.02, 4.97, 3.5, 1.6), 1e-3, &point_));
    at_.y = Eigen::Vector2d(-0.6, 0.2);
    at_.lower = VectorX::Zero(5);
    at_.upper = VectorX::Zero(5);
    for (int i = 0; i < 5; ++i) {
      if (barrier_.has_lower(i)) at_.lower(i) = 0.3 + 0.1 * i;
      if (barrier_.has_upper(i)) at_.upper(i) = 0.2 + 0.05 * i;
    }
    VectorX gradient(4);
    EXPECT_TRUE(barrier_.Gradient(point_, &gradient));
    EXPECT_TRUE(
        problem_.Derivatives(point_.w.data(), 1, at_.y.data(), newton_.kkt().jacobian(), newton_.kkt().hessian()));
    EXPECT_TRUE(problem_.Jacobian(point_.w.data(), jacobian_.data()));
    lagrangian_ = VectorX::Zero(5);
    lagrangian_.head(4) = gradient + jacobian_.transpose() * at_.y;
    lagrangian_(4) = -at_.y(0);
    EXPECT_TRUE(newton_.Compute(point_, at_, lagrangian_, kMu, &step_));
    EXPECT_EQ(newton_.regularization(), 0);
  }

  // d z + d Δz + z Δd of a bound.
  double Product(int i, bool lower, const NewtonStep& step) const {
    const double distance = lower ? point_.w(i) - barrier_.lower(i) : barrier_.upper(i) - point_.w(i);
    const double change = lower ? step.w(i) : -step.w(i);
    const double z = lower ? at_.lower(i) : at_.upper(i);
    const double z_change = lower ? step.multipliers.lower(i) : step.multipliers.upper(i);
    return distance * z + distance * z_change + change * z;
  }

  // Rows of the linearised constraints and of the gradient of the Lagrangian, which no target of the products enters.
  void ExpectLinearised(const NewtonStep& step) {
    const VectorX rows = jacobian_ * step.w.head(4) - Eigen::Vector2d(step.w(4), 0) + point_.c;
    EXPECT_LT(rows.norm(), 1e-9);
    MatrixX hessian = MatrixX::Zero(4, 4);
    std::vector<double> values(10);
    EXPECT_TRUE(problem_.Hessian(point_.w.data(), 1, at_.y.data(), values.data()));
    for (int r = 0, e = 0; r < 4; ++r) {
      for (int c = 0; c <= r; ++c, ++e) hessian(r, c) = hessian(c, r) = values[e];
    }
    const VectorX gradient = lagrangian_.head(4) + hessian * step.w.head(4) +
                             jacobian_.transpose() * step.multipliers.y - (at_.lower + step.multipliers.lower).head(4) +
                             (at_.upper + step.multipliers.upper).head(4);
    EXPECT_LT(gradient.norm(), 1e-9);
    // The slack has one bound, hence the damping 1e-5 μ.
    EXPECT_NEAR(lagrangian_(4) - step.multipliers.y(0) - at_.lower(4) - step.multipliers.lower(4) + 1e-5 * kMu, 0,
                1e-9);
  }

  static constexpr double kMu = 1e-2;
  Hs071 problem_;
  BarrierProblem barrier_;
  NewtonSystem newton_;
  BarrierProblem::Point point_;
  Multipliers at_;
  Eigen::Matrix<double, 2, 4, Eigen::RowMajor> jacobian_;
  VectorX lagrangian_;
  NewtonStep step_;
};

TEST_F(NewtonStepTest, SolvesTheLinearisedBarrierEquations) {
  ExpectLinearised(step_);
  for (int i = 0; i < 5; ++i) {
    for (const bool lower : {true, false}) {
      if (!(lower ? barrier_.has_lower(i) : barrier_.has_upper(i))) continue;
      EXPECT_NEAR(Product(i, lower, step_), kMu, 1e-12) << i << lower;
    }
  }
}

TEST_F(NewtonStepTest, RecentredAimsAtCentralProducts) {
  constexpr double kPrimal = 0.9, kDual = 0.7;
  NewtonStep recentred;
  ASSERT_TRUE(newton_.Recentre(point_, at_, kMu, step_, kPrimal, kDual, &recentred));
  ExpectLinearised(recentred);
  int corrected = 0;
  for (int i = 0; i < 5; ++i) {
    for (const bool lower : {true, false}) {
      if (!(lower ? barrier_.has_lower(i) : barrier_.has_upper(i))) continue;
      const double distance = lower ? point_.w(i) - barrier_.lower(i) : barrier_.upper(i) - point_.w(i);
      const double after = (distance + kPrimal * (lower ? step_.w(i) : -step_.w(i))) *
                           (lower ? at_.lower(i) + kDual * step_.multipliers.lower(i)
                                  : at_.upper(i) + kDual * step_.multipliers.upper(i));
      double aim = kMu;
      if (after < 0.1 * kMu) aim += 0.1 * kMu - after;
      if (after > 10 * kMu) aim -= std::min(after - 10 * kMu, 10 * kMu);
      corrected += aim != kMu ? 1 : 0;
      EXPECT_NEAR(Product(i, lower, recentred), aim, 1e-12) << i << lower;
    }
  }
  EXPECT_GT(corrected, 1);
}

// The second multiplier makes the Hessian one of −20 in every direction, more than the first or the bounds make up for.
TEST_F(NewtonStepTest, TheFirstShiftIsThatOfTheOptions) {
  at_.y = Eigen::Vector2d(0, -10);
  at_.lower *= 1e-9;
  at_.upper *= 1e-9;
  const auto regularization = [&](const NlpOptions& options) {
    NewtonSystem newton(barrier_, options);
    EXPECT_TRUE(
        problem_.Derivatives(point_.w.data(), 1, at_.y.data(), newton.kkt().jacobian(), newton.kkt().hessian()));
    EXPECT_TRUE(newton.Compute(point_, at_, lagrangian_, kMu, &step_));
    return newton.regularization();
  };
  EXPECT_NEAR(regularization({}), 1e-4 * 1e6, 1e-9) << "that of Ipopt, times a hundred until it does";
  EXPECT_EQ(regularization({.first_shift = 50}), 50);
}

}  // namespace
}  // namespace rollgait
