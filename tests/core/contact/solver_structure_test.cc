// The solver that knows the tree against the one that takes any mass matrix, and against the equations themselves;
// sensitivities ask for no memory once they have it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/contact/constrained_dynamics.h"
#include "core/contact/contact_sensitivity.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/contact_tree.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

using testing::ContactTree;
using testing::RandomVector;

const Vector3 kGravity(0.3, 0.2, -9.7);

class SolverStructureTest : public ::testing::TestWithParam<unsigned> {
 protected:
  SolverStructureTest() {
    dynamics_.SetState(tree_.q, tree_.v, tree_.ground);
    mass_ = dynamics_.MassMatrix();
    force_ = RandomVector(tree_.random, tree_.model.nv());
    dynamics_.AccelerationRows({0, 1, 2, 3}, {}, &rows_, &right_);
  }
  // Rows that depend on each other and do not contradict.
  void RepeatRows(int count) {
    const int m = static_cast<int>(rows_.rows());
    rows_.conservativeResize(m + count, rows_.cols());
    right_.conservativeResize(m + count);
    for (int i = 0; i < count; ++i) {
      rows_.row(m + i) = 2 * rows_.row(i) - rows_.row(i + 1);
      right_[m + i] = 2 * right_[i] - right_[i + 1];
    }
  }

  ContactTree tree_{GetParam()};
  ContactDynamics dynamics_{BodyDynamics(tree_.model), tree_.contacts};
  MatrixX mass_, rows_;
  VectorX force_, right_;
};

TEST_P(SolverStructureTest, BothTakeTheSameRowsForRedundant) {
  const int independent = static_cast<int>(rows_.rows());
  for (const int repeated : {0, 1, 3}) {
    if (repeated > 0) RepeatRows(repeated);
    ConstrainedSolver any, along_tree(tree_.model.ColumnParents());
    ConstrainedSolution expected, solution;
    any.Solve(mass_, force_, rows_, right_, &expected);
    along_tree.Solve(mass_, force_, rows_, right_, &solution);
    EXPECT_EQ(expected.rank, independent);
    EXPECT_EQ(solution.rank, independent);
    EXPECT_EQ(solution.redundant, repeated > 0);
    EXPECT_LT(solution.residual, 1e-9);
    const double size = expected.acceleration.norm() + expected.forces.norm();
    EXPECT_TRUE(MatrixNear(solution.acceleration, expected.acceleration, 1e-10 * size));
    EXPECT_TRUE(MatrixNear(solution.forces, expected.forces, 1e-10 * size));
  }
}

// Rows closer to each other than rounding are redundant, rows further apart are not.
TEST_P(SolverStructureTest, DecidesBetweenAlmostEqualRowsAlike) {
  for (const double apart : {1e-8, 1e-12}) {
    MatrixX rows(2, rows_.cols());
    rows << rows_.row(0), rows_.row(0) + apart * rows_.row(1);
    const VectorX right = VectorX::Zero(2);
    ConstrainedSolver any, along_tree(tree_.model.ColumnParents());
    ConstrainedSolution expected, solution;
    any.Solve(mass_, force_, rows, right, &expected);
    along_tree.Solve(mass_, force_, rows, right, &solution);
    EXPECT_EQ(expected.rank, apart > 1e-10 ? 2 : 1);
    EXPECT_EQ(solution.rank, expected.rank);
  }
}

// A linear map: what it does to changes as large as the arguments themselves is what Solve does.
TEST_P(SolverStructureTest, DerivativesAreThoseOfTheSolution) {
  for (const int repeated : {0, 2}) {
    if (repeated > 0) RepeatRows(repeated);
    ConstrainedSolver solver(tree_.model.ColumnParents());
    ConstrainedSolution solution, changed;
    solver.Solve(mass_, force_, rows_, right_, &solution);
    RowMajorMatrix acceleration(mass_.rows(), 3), forces(rows_.rows(), 3);
    std::vector<VectorX> by_force, by_right;
    for (int k = 0; k < 3; ++k) {
      acceleration.col(k) = by_force.emplace_back(RandomVector(tree_.random, static_cast<int>(mass_.rows())));
      // Right sides that the rows can meet.
      forces.col(k) = by_right.emplace_back(rows_ * RandomVector(tree_.random, static_cast<int>(mass_.rows())));
    }
    solver.Differentiate(&acceleration, &forces);
    for (int k = 0; k < 3; ++k) {
      ConstrainedSolver().Solve(mass_, force_ + by_force[static_cast<size_t>(k)], rows_,
                                right_ + by_right[static_cast<size_t>(k)], &changed);
      const double size = changed.acceleration.norm() + changed.forces.norm() + solution.forces.norm();
      EXPECT_TRUE(MatrixNear(acceleration.col(k), changed.acceleration - solution.acceleration, 1e-10 * size));
      EXPECT_TRUE(MatrixNear(forces.col(k), changed.forces - solution.forces, 1e-10 * size));
      EXPECT_GT(acceleration.col(k).norm(), 0);
    }
  }
}

TEST_P(SolverStructureTest, SensitivitiesAskForNoMemory) {
  ContactSensitivitySolver solver(tree_.model, &dynamics_);
  const std::vector<int> all = {0, 1, 2, 3};
  solver.Solve(all, force_, kGravity, {});
  const long before = Allocations();
  double sum = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    dynamics_.SetState(tree_.q, tree_.v, tree_.ground);
    sum += solver.Solve(all, force_, kGravity, {}).acceleration_q.sum();
  }
  EXPECT_EQ(Allocations() - before, 0);
  EXPECT_TRUE(std::isfinite(sum));
  ::operator delete(::operator new(1));  // unlike a new expression, no compiler may leave it out
  EXPECT_GT(Allocations(), before);      // the counter counts
}

INSTANTIATE_TEST_SUITE_P(Seeds, SolverStructureTest, ::testing::Range(1u, 6u));

}  // namespace
}  // namespace rollgait
