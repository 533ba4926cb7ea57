#include "core/multibody/tree_dynamics.h"

#include <gtest/gtest.h>

#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::kGravity;
using testing::RandomTree;
using testing::RandomVector;

struct Point {
  VectorX q, v, a;
};

Point RandomPoint(std::mt19937& random, int n) {
  return {RandomVector(random, n, 2), RandomVector(random, n, 2), RandomVector(random, n, 5)};
}

VectorX InverseDynamicsAt(TreeDynamics& tree, const Point& at) {
  VectorX tau(tree.size());
  tree.Update(at.q.data(), at.v.data(), at.a.data(), kGravity);
  tree.InverseDynamics(tau.data());
  return tau;
}

struct First {
  MatrixX q, v, a;
};

First FirstAt(TreeDynamics& tree, const Point& at) {
  const int n = tree.size();
  First d{MatrixX::Zero(n, n), MatrixX::Zero(n, n), MatrixX::Zero(n, n)};
  tree.Update(at.q.data(), at.v.data(), at.a.data(), kGravity);
  tree.FirstDerivatives(d.q, d.v, d.a);
  return d;
}

// Central difference of f along unit vector j of the chosen member of the point; the error is O(step²) = 1e-10 from
// truncation and 1e-16/1e-5 = 1e-11 from rounding, times the growth of third derivatives over a tree: 1e-7 of the
// largest entry is safe.
template <typename F>
auto Difference(F f, const Point& at, VectorX Point::*member, int j) {
  const double step = 1e-5;
  Point up = at, down = at;
  (up.*member)(j) += step;
  (down.*member)(j) -= step;
  return ((f(up) - f(down)) / (2 * step)).eval();
}

class TreeDynamicsTest : public ::testing::TestWithParam<int> {};

TEST_P(TreeDynamicsTest, FirstDerivativesMeetDifferences) {
  std::mt19937 random(7 + GetParam());
  const Model model = RandomTree(random, GetParam());
  TreeDynamics tree(model);
  const Point at = RandomPoint(random, GetParam());
  const First d = FirstAt(tree, at);
  const auto f = [&](const Point& p) { return InverseDynamicsAt(tree, p); };
  const double scale = 1 + d.q.cwiseAbs().maxCoeff();
  for (int j = 0; j < GetParam(); ++j) {
    EXPECT_LT((Difference(f, at, &Point::q, j) - d.q.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "q" << j;
    EXPECT_LT((Difference(f, at, &Point::v, j) - d.v.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "v" << j;
    EXPECT_LT((Difference(f, at, &Point::a, j) - d.a.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "a" << j;
  }
  EXPECT_GT(d.q.cwiseAbs().maxCoeff(), 1);
  EXPECT_LT((d.a - d.a.transpose()).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

TEST_P(TreeDynamicsTest, ContractedHessianMeetsDifferencesOfFirstDerivatives) {
  const int n = GetParam();
  std::mt19937 random(70 + n);
  const Model model = RandomTree(random, n);
  TreeDynamics tree(model);
  const Point at = RandomPoint(random, n);
  const VectorX lambda = RandomVector(random, n);
  MatrixX qq = MatrixX::Zero(n, n), qv = qq, qa = qq, vv = qq;
  InverseDynamicsAt(tree, at);
  tree.AddContractedHessian(lambda.data(), qq, qv, qa, vv);
  const double scale = 1 + qq.cwiseAbs().maxCoeff();
  const auto gradient_q = [&](const Point& p) { return (FirstAt(tree, p).q.transpose() * lambda).eval(); };
  const auto gradient_v = [&](const Point& p) { return (FirstAt(tree, p).v.transpose() * lambda).eval(); };
  for (int j = 0; j < n; ++j) {
    EXPECT_LT((Difference(gradient_q, at, &Point::q, j) - qq.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "qq" << j;
    EXPECT_LT((Difference(gradient_q, at, &Point::v, j) - qv.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "qv" << j;
    EXPECT_LT((Difference(gradient_q, at, &Point::a, j) - qa.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "qa" << j;
    EXPECT_LT((Difference(gradient_v, at, &Point::v, j) - vv.col(j)).cwiseAbs().maxCoeff(), 1e-7 * scale) << "vv" << j;
  }
  EXPECT_GT(qq.cwiseAbs().maxCoeff(), 0.1);
  if (n > 1) {
    EXPECT_GT(qv.cwiseAbs().maxCoeff(), 0.1);
  }
}

// Two derivations: row by row as the Hessian of one combination, and all rows at once. Both sum at most some hundred
// products of the size of the largest entry: 1e-12 of it leaves a factor of 30 to rounding.
TEST_P(TreeDynamicsTest, SecondDerivativesOfEveryRowAreTheContractedHessiansOfUnitVectors) {
  const int n = GetParam();
  std::mt19937 random(700 + n);
  const Model model = RandomTree(random, n);
  TreeDynamics tree(model);
  const Point at = RandomPoint(random, n);
  InverseDynamicsAt(tree, at);
  RowHessians rows(n);
  tree.SecondDerivatives(&rows);
  for (int l = 0; l < n; ++l) {
    MatrixX qq = MatrixX::Zero(n, n), qv = qq, qa = qq, vv = qq;
    tree.AddContractedHessian(VectorX(VectorX::Unit(n, l)).data(), qq, qv, qa, vv);
    const double scale = 1e-12 * (1 + qq.cwiseAbs().maxCoeff() + qv.cwiseAbs().maxCoeff());
    EXPECT_LT((rows.Row(rows.qq, l) - qq).cwiseAbs().maxCoeff(), scale) << l;
    EXPECT_LT((rows.Row(rows.qv, l) - qv).cwiseAbs().maxCoeff(), scale) << l;
    EXPECT_LT((rows.Row(rows.qa, l) - qa).cwiseAbs().maxCoeff(), scale) << l;
    EXPECT_LT((rows.Row(rows.vv, l) - vv).cwiseAbs().maxCoeff(), scale) << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TreeDynamicsTest, ::testing::Values(1, 2, 4, 9, 29));

}  // namespace
}  // namespace rollgait
