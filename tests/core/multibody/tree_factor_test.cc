// The factor along the branches of a tree against dense Cholesky of the same mass matrix.
#include "core/multibody/tree_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <utility>
#include <vector>

#include "core/multibody/body_dynamics.h"
#include "core/multibody/configuration.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::RandomVector;

class TreeFactorTest : public ::testing::TestWithParam<unsigned> {
 protected:
  // Branches at random; joints 0 and 5 are free, and 5 is another root.
  Model MakeModel() {
    std::vector<Joint> joints = testing::RandomTree(random_, 11).joints();
    joints[5].parent = -1;
    return testing::WithFreeJoints(std::move(joints), {0, 5});
  }
  MatrixX Mass(const Model& model) {
    const BodyDynamics dynamics(model);
    BodyDynamics::State state;
    BodyDynamics::Workspace workspace;
    MatrixX mass;
    dynamics.ComputeState(Retract(model, NeutralConfiguration(model), RandomVector(random_, model.nv())),
                          VectorX::Zero(model.nv()), &state);
    dynamics.MassMatrix(state, &workspace, &mass);
    return mass;
  }

  std::mt19937 random_{GetParam()};
};

TEST_P(TreeFactorTest, SolvesAsDenseCholeskyDoes) {
  const Model model = MakeModel();
  const MatrixX mass = Mass(model);
  const int n = model.nv();
  TreeFactor tree(model.ColumnParents()), dense = TreeFactor::Dense(n);
  ASSERT_EQ(tree.size(), n);
  tree.Factorise(mass);
  dense.Factorise(mass);
  int saved = 0;
  for (int c = 0; c < n; ++c) saved += dense.path_length(c) - tree.path_length(c);
  EXPECT_GT(saved, n);
  // Widths with and without a remainder of four, and a stride beyond the columns.
  for (const int width : {1, 4, 7, 8}) {
    RowMajorMatrix x(n, width + 2);
    for (int c = 0; c < x.cols(); ++c) x.col(c) = RandomVector(random_, n);
    const RowMajorMatrix given = x;
    const MatrixX expected = mass.llt().solve(MatrixX(given.leftCols(width)));
    for (TreeFactor* factor : {&tree, &dense}) {
      x = given;
      factor->SolveTransposed(x.data(), width + 2, width);
      // L⁻ᵀ is a square root of M⁻¹.
      EXPECT_TRUE(MatrixNear(x.leftCols(width).transpose() * x.leftCols(width),
                             given.leftCols(width).transpose() * expected, 1e-11 * expected.norm()));
      factor->Solve(x.data(), width + 2, width);
      EXPECT_TRUE(MatrixNear(x.leftCols(width), expected, 1e-11 * expected.norm()));
      EXPECT_TRUE(MatrixNear(x.rightCols(2), given.rightCols(2), 0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TreeFactorTest, ::testing::Range(1u, 6u));

}  // namespace
}  // namespace rollgait
