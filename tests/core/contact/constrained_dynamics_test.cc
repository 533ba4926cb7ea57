#include "core/contact/constrained_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"
#include "tests/support/rolling_body.h"

namespace rollgait {
namespace {

using testing::RandomTree;
using testing::RandomVector;

const Vector3 kGravity(0.5, 0.2, -9.7);

class ConstrainedDynamicsTest : public ::testing::Test {
 protected:
  static constexpr int kSize = 12;

  ConstrainedDynamicsTest() : random_(7), model_(RandomTree(random_, kSize)), dynamics_(model_) {
    q_ = RandomVector(random_, kSize);
    v_ = RandomVector(random_, kSize);
    tau_ = RandomVector(random_, kSize, 10);
    surfaces_[0].joint = kSize - 1;
    surfaces_[1].joint = kSize - 2;
    for (ContactSurface& surface : surfaces_) {
      surface.surface = Ellipsoid(Vector3(0.4, 0.3, 0.2));
      surface.p_LE = RandomVector(random_, 3);
      surface.R_LE = testing::RandomRotation(random_);
    }
    surfaces_[1].directions = {0, 2};
  }

  std::mt19937 random_;
  Model model_;
  BodyDynamics dynamics_;
  VectorX q_, v_, tau_;
  ContactSurface surfaces_[2];
};

// Against the saddle-point matrix written out and factorised by Gaussian elimination with full pivoting.
TEST_F(ConstrainedDynamicsTest, MeetsTheSaddlePointSystem) {
  ConstrainedDynamics constrained(dynamics_, {surfaces_[0], surfaces_[1]});
  const ConstrainedSolution& solution = constrained.Evaluate(q_, v_, tau_, kGravity);

  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  MatrixX mass, jacobian(5, kSize);
  VectorX bias;
  dynamics_.ComputeState(q_, v_, &state);
  dynamics_.MassMatrix(state, &workspace, &mass);
  dynamics_.BiasForce(state, kGravity, &workspace, &bias);
  const RollingContact first = ComputeRollingContact(surfaces_[0], state);
  const RollingContact second = ComputeRollingContact(surfaces_[1], state);
  RollingJacobian(dynamics_, surfaces_[0], state, first.p_WP, 0, &jacobian);
  RollingJacobian(dynamics_, surfaces_[1], state, second.p_WP, 3, &jacobian);
  MatrixX matrix = MatrixX::Zero(kSize + 5, kSize + 5);
  matrix << mass, -jacobian.transpose(), jacobian, MatrixX::Zero(5, 5);
  VectorX right(kSize + 5);
  right << tau_ - bias, -first.drift, -second.drift.x(), -second.drift.z();
  const VectorX expected = matrix.fullPivLu().solve(right);

  EXPECT_EQ(solution.rank, 5);
  EXPECT_FALSE(solution.redundant);
  EXPECT_TRUE(MatrixNear(solution.acceleration, expected.head(kSize), 1e-10 * expected.norm()));
  EXPECT_TRUE(MatrixNear(solution.forces, expected.tail(5), 1e-10 * expected.norm()));
  EXPECT_GT(solution.forces.norm(), 1.0);
  EXPECT_TRUE(MatrixNear(constrained.Force(1), Vector3(solution.forces[3], 0, solution.forces[4]), 0));
}

TEST_F(ConstrainedDynamicsTest, WithoutContactsTheTreeIsFree) {
  ConstrainedDynamics constrained(dynamics_, {});
  const ConstrainedSolution& solution = constrained.Evaluate(q_, v_, tau_, kGravity);
  BodyDynamics::Workspace workspace;
  VectorX tau;
  dynamics_.InverseDynamics(constrained.state(), solution.acceleration, kGravity, &workspace, &tau);
  EXPECT_TRUE(MatrixNear(tau, tau_, 1e-10));
  EXPECT_EQ(solution.rank, 0);
  EXPECT_FALSE(solution.redundant);
}

TEST_F(ConstrainedDynamicsTest, RedundantRowsAreSaidAndDoNotHarm) {
  ConstrainedDynamics once(dynamics_, {surfaces_[0]}), twice(dynamics_, {surfaces_[0], surfaces_[0]});
  const ConstrainedSolution expected = once.Evaluate(q_, v_, tau_, kGravity);
  const ConstrainedSolution& solution = twice.Evaluate(q_, v_, tau_, kGravity);
  EXPECT_FALSE(expected.redundant);
  EXPECT_TRUE(solution.redundant);
  EXPECT_EQ(solution.rank, 3);
  EXPECT_LT(solution.residual, 1e-9);
  EXPECT_TRUE(MatrixNear(solution.acceleration, expected.acceleration, 1e-10 * expected.acceleration.norm()));
  // The forces of least norm share the load.
  EXPECT_TRUE(MatrixNear(twice.Force(0), 0.5 * once.Force(0), 1e-9 * once.Force(0).norm()));
  EXPECT_TRUE(MatrixNear(twice.Force(1), 0.5 * once.Force(0), 1e-9 * once.Force(0).norm()));
}

// Two surfaces on one link cannot have their contact points approach each other: one row of six is redundant.
TEST_F(ConstrainedDynamicsTest, TwoContactsOfOneLinkHaveRankFive) {
  ContactSurface other = surfaces_[0];
  other.p_LE += Vector3(0.6, 0.1, -0.2);
  ConstrainedDynamics constrained(dynamics_, {surfaces_[0], other});
  EXPECT_EQ(constrained.Evaluate(q_, v_, tau_, kGravity).rank, 5);
}

TEST(ConstrainedSolver, ContradictoryRowsShowInTheResidual) {
  ConstrainedSolver solver;
  ConstrainedSolution solution;
  MatrixX jacobian(2, 3);
  jacobian << 1, 2, 0, 1, 2, 0;
  solver.Solve(MatrixX::Identity(3, 3), VectorX::Zero(3), jacobian, Eigen::Vector2d(1, 3), &solution);
  EXPECT_TRUE(solution.redundant);
  EXPECT_GT(solution.residual, 0.9);
}

TEST(ConstrainedSolver, RowsWithoutEffectTransmitNothing) {
  ConstrainedSolver solver;
  ConstrainedSolution solution;
  solver.Solve(2 * MatrixX::Identity(3, 3), VectorX::Ones(3), MatrixX::Zero(2, 3), VectorX::Zero(2), &solution);
  EXPECT_EQ(solution.rank, 0);
  EXPECT_TRUE(solution.redundant);
  EXPECT_TRUE(MatrixNear(solution.acceleration, VectorX::Constant(3, 0.5), 1e-15));
  EXPECT_TRUE(MatrixNear(solution.forces, VectorX::Zero(2), 0));
}

TEST_F(ConstrainedDynamicsTest, BaumgarteTermsAreOffUnlessGiven) {
  ConstrainedDynamics plain(dynamics_, {surfaces_[0]}), corrected(dynamics_, {surfaces_[0]}, Baumgarte{3, 0.7, 2});
  const auto rate_of_slip = [&](ConstrainedDynamics& constrained) {
    const ConstrainedSolution& solution = constrained.Evaluate(q_, v_, tau_, kGravity);
    MatrixX jacobian(3, kSize);
    RollingJacobian(dynamics_, surfaces_[0], constrained.state(), constrained.contact(0).p_WP, 0, &jacobian);
    return Vector3(jacobian * solution.acceleration + constrained.contact(0).drift);
  };
  EXPECT_TRUE(MatrixNear(rate_of_slip(plain), Vector3::Zero(), 1e-9));
  const Vector3 rate = rate_of_slip(corrected);
  const RollingContact& contact = corrected.contact(0);
  const Vector3 expected(-2 * contact.slip.x(), -2 * contact.slip.y(),
                         -2 * 0.7 * 3 * contact.slip.z() - 9 * contact.gap);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_TRUE(MatrixNear(rate, expected, 1e-9));
}

TEST(ConstrainedDynamics, BallOnAnIncline) {
  const double radius = 0.3, mass = 2, slope = 0.2;
  const RollingBody ball = MakeRollingBody(Vector3::Constant(radius), mass, Vector3::Zero(),
                                           0.4 * mass * radius * radius * Matrix3::Identity());
  VectorX q, v;
  const Matrix3 R = Eigen::AngleAxisd(0.8, Vector3(1, 2, 2) / 3).toRotationMatrix();
  SetRolling(Vector3::Constant(radius), R, Vector3(0.5, 2, -7), 0.1, 0.2, &q, &v);
  ConstrainedDynamics constrained(BodyDynamics(ball.model), {ball.surface});
  const Vector3 gravity = 9.81 * Vector3(std::sin(slope), 0, -std::cos(slope));
  const ConstrainedSolution& solution = constrained.Evaluate(q, v, VectorX::Zero(6), gravity);
  const Vector3 expected(5.0 / 7 * gravity.x(), 0, 0);
  EXPECT_TRUE(MatrixNear(solution.acceleration.head(3), expected, 1e-12));
  EXPECT_TRUE(MatrixNear(constrained.Force(0), mass * (expected - gravity), 1e-12));
  EXPECT_LT(constrained.contact(0).slip.norm(), 1e-14);
}

// Forces of a rolling triaxial ellipsoid at the reference's states, without integration.
TEST(ConstrainedDynamics, TriaxialReferenceForces) {
  const Vector3 axes(0.319, 0.242, 0.098);
  const RollingBody body = MakeRollingBody(axes, 0.365, Vector3::Zero(),
                                           Vector3(0.004976264, 0.008129645, 0.011703724999999998).asDiagonal());
  ConstrainedDynamics constrained(BodyDynamics(body.model), {body.surface});
  const Vector3 gravity(1.7034886229125867, 0, -9.66096405704976);
  const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/triaxial_tri_08_side_tilt10.csv");
  ASSERT_EQ(rows.size(), 21u);
  for (const ReferenceRow& row : rows) {
    VectorX q, v;
    SetRolling(axes, row.R, row.R * row.omega, row.x, row.y, &q, &v);
    constrained.Evaluate(q, v, VectorX::Zero(6), gravity);
    // Rounding of the row's 16 digits, enlarged by the curvature of the surface.
    EXPECT_TRUE(MatrixNear(constrained.Force(0), row.force, 1e-12)) << row.t;
    EXPECT_TRUE(MatrixNear(q.head(3), row.com, 1e-14)) << row.t;
    EXPECT_TRUE(MatrixNear(v.head(3), row.v_com, 1e-14)) << row.t;
  }
}

}  // namespace
}  // namespace rollgait
