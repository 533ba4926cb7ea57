#include "core/nlp/kkt_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "core/nlp/nlp_options.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

// The matrix of a problem of four variables and two rows, of which `fixed` are taken out and the first may have a
// slack, beside the same in dense algebra.
class KktSystemTest : public ::testing::Test {
 protected:
  void Fill(const std::vector<char>& fixed, const std::vector<int>& slack_rows = {}) {
    kkt_ = std::make_unique<KktSystem>(problem_, fixed, slack_rows, NlpOptions().step_residual);
    const Eigen::Vector4d x(1.5, 4, 3, 2);
    const Eigen::Vector2d multipliers(0.7, -0.3);
    ASSERT_TRUE(problem_.Derivatives(x.data(), 1, multipliers.data(), kkt_->jacobian(), kkt_->hessian()));
    kkt_->TakeDerivatives();
    dense_ = MatrixX::Zero(6, 6);
    const SparsityPattern &hessian = problem_.hessian_pattern(), &jacobian = problem_.jacobian_pattern();
    for (int e = 0; e < hessian.size(); ++e) {
      dense_(hessian.rows[e], hessian.columns[e]) = dense_(hessian.columns[e], hessian.rows[e]) = kkt_->hessian()[e];
    }
    for (int e = 0; e < jacobian.size(); ++e) {
      dense_(4 + jacobian.rows[e], jacobian.columns[e]) = dense_(jacobian.columns[e], 4 + jacobian.rows[e]) =
          kkt_->jacobian()[e];
    }
    dense_.diagonal().head(4) += primal_;
    dense_.diagonal().tail(2) -= dual_;
    right_ = Eigen::Vector<double, 6>(1, -2, 3, -4, 5, -6);
    for (int i = 0; i < 4; ++i) {
      if (fixed[static_cast<size_t>(i)] == 0) continue;
      dense_.row(i).setZero();
      dense_.col(i).setZero();
      dense_(i, i) = 1;
      right_(i) = 0;
    }
  }

  // Solves with right-hand sides of which the fixed variables' part must not count.
  void ExpectDenseSolution() {
    VectorX u, v;
    bool is_solved = false;
    do {
      ASSERT_EQ(kkt_->Factorise(primal_, dual_), KktSystem::Outcome::kRight);
      is_solved = kkt_->Solve(Eigen::Vector4d(1, -2, 3, -4), Eigen::Vector2d(5, -6), &u, &v);
    } while (!is_solved && kkt_->TryHarder());
    ASSERT_TRUE(is_solved);
    VectorX solution(6);
    solution << u, v;
    EXPECT_LT((solution - dense_.fullPivLu().solve(right_)).norm(), 1e-9);
  }

  Hs071 problem_;
  std::unique_ptr<KktSystem> kkt_;
  const VectorX primal_ = Eigen::Vector4d(30, 40, 50, 60);
  VectorX dual_ = Eigen::Vector2d(0.5, 0);
  MatrixX dense_;
  VectorX right_;
};

TEST_F(KktSystemTest, SolvesLikeDenseAlgebra) {
  Fill({0, 0, 0, 0});
  ExpectDenseSolution();
}

TEST_F(KktSystemTest, TakesFixedVariablesOut) {
  for (int i = 0; i < 4; ++i) {
    std::vector<char> fixed(4, 0);
    fixed[static_cast<size_t>(i)] = 1;
    Fill(fixed);
    ExpectDenseSolution();
  }
}

// From a row that is far from its bounds to one that is at them.
TEST_F(KktSystemTest, EliminatesRowsWithSlacks) {
  for (const double d : {1e6, 0.5, 1e-6, 1e-12, 1e-16}) {
    dual_(0) = d;
    Fill({0, 0, 0, 0}, {0});
    ExpectDenseSolution();
    Fill({0, 0, 1, 0}, {0});
    ExpectDenseSolution();
  }
}

TEST_F(KktSystemTest, SeesAWrongInertia) {
  for (const std::vector<int>& slack_rows : {std::vector<int>{}, {0}}) {
    Fill({0, 0, 0, 0}, slack_rows);
    EXPECT_EQ(kkt_->Factorise(VectorX::Constant(4, -100), dual_), KktSystem::Outcome::kWrongInertia);
  }
}

TEST_F(KktSystemTest, MultipliesByTheJacobianOfFixedVariablesToo) {
  Fill({0, 1, 0, 0});
  const Eigen::Vector2d v(2, -3);
  VectorX y = VectorX::Ones(4), expected = y;
  for (int e = 0; e < problem_.jacobian_pattern().size(); ++e) {
    expected(problem_.jacobian_pattern().columns[e]) += kkt_->jacobian()[e] * v(problem_.jacobian_pattern().rows[e]);
  }
  kkt_->AddTransposedProduct(v, &y);
  EXPECT_LT((y - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace rollgait
