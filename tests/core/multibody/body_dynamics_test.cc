#include "core/multibody/body_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "core/multibody/tree_dynamics.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::kGravity;
using testing::RandomTree;
using testing::RandomVector;

// A random tree on a smooth motion  q(t) = q + v t + a t²/2.
class BodyDynamicsTest : public ::testing::TestWithParam<int> {
 protected:
  BodyDynamicsTest() : random_(GetParam()), model_(RandomTree(random_, GetParam())), dynamics_(model_) {
    q_ = RandomVector(random_, GetParam());
    v_ = RandomVector(random_, GetParam());
    a_ = RandomVector(random_, GetParam());
    state_ = At(0);
  }

  BodyDynamics::State At(double t) const {
    BodyDynamics::State state;
    dynamics_.ComputeState(q_ + v_ * t + 0.5 * t * t * a_, v_ + a_ * t, &state);
    return state;
  }

  // Central difference of order 4 in t; its error is about 1e-12 for the sizes of these trees.
  template <typename F>
  auto Rate(F value) const {
    const double h = 1e-3;
    auto near = value(At(h)), minus_near = value(At(-h)), far = value(At(2 * h)), minus_far = value(At(-2 * h));
    decltype(near) rate = (8 * (near - minus_near) - (far - minus_far)) / (12 * h);
    return rate;
  }

  std::mt19937 random_;
  Model model_;
  BodyDynamics dynamics_;
  BodyDynamics::Workspace workspace_;
  VectorX q_, v_, a_;
  BodyDynamics::State state_;
};

TEST_P(BodyDynamicsTest, MassMatrixColumnsAreInverseDynamicsOfUnitAccelerations) {
  const int n = GetParam();
  MatrixX mass;
  dynamics_.MassMatrix(state_, &workspace_, &mass);
  VectorX tau, bias;
  dynamics_.BiasForce(state_, kGravity, &workspace_, &bias);
  MatrixX columns(n, n);
  for (int j = 0; j < n; ++j) {
    dynamics_.InverseDynamics(state_, VectorX::Unit(n, j), kGravity, &workspace_, &tau);
    columns.col(j) = tau - bias;
  }
  EXPECT_TRUE(MatrixNear(mass, columns, 1e-12 * columns.norm() + 1e-12 * bias.norm()));
  EXPECT_EQ(Eigen::LLT<MatrixX>(mass).info(), Eigen::Success);
  EXPECT_GT(bias.norm(), 1.0);
}

TEST_P(BodyDynamicsTest, InverseDynamicsMeetsTheWorldFrameAlgorithm) {
  TreeDynamics tree(model_);
  tree.Update(q_.data(), v_.data(), a_.data(), kGravity);
  VectorX expected(GetParam()), tau;
  tree.InverseDynamics(expected.data());
  dynamics_.InverseDynamics(state_, a_, kGravity, &workspace_, &tau);
  EXPECT_TRUE(MatrixNear(tau, expected, 1e-12 * expected.norm()));
}

TEST_P(BodyDynamicsTest, TwistsAreRatesOfPoses) {
  for (int i = 0; i < GetParam(); ++i) {
    const Vector3 v = Rate([i](const auto& s) { return Vector3(s[i].p_WL); });
    const Matrix3 R_dot = Rate([i](const auto& s) { return Matrix3(s[i].R_WL); });
    const Matrix3 w = R_dot * state_[i].R_WL.transpose();
    EXPECT_TRUE(MatrixNear(state_[i].R_WL * state_[i].twist.linear, v, 1e-9));
    EXPECT_TRUE(MatrixNear(state_[i].R_WL * state_[i].twist.angular, Vector3(w(2, 1), w(0, 2), w(1, 0)), 1e-9));
  }
}

TEST_P(BodyDynamicsTest, BiasIsTheAccelerationWithoutJointAccelerations) {
  a_.setZero();
  for (int i = 0; i < GetParam(); ++i) {
    const auto& link = state_[i];
    const Vector3 alpha = Rate([i](const auto& s) { return Vector3(s[i].R_WL * s[i].twist.angular); });
    const Vector3 a = Rate([i](const auto& s) { return Vector3(s[i].R_WL * s[i].twist.linear); });
    EXPECT_TRUE(MatrixNear(link.R_WL * link.bias.angular, alpha, 1e-9));
    EXPECT_TRUE(MatrixNear(link.R_WL * (link.bias.linear + link.twist.angular.cross(link.twist.linear)), a, 1e-9));
  }
}

TEST_P(BodyDynamicsTest, PowerOfTheGeneralizedForcesIsTheRateOfEnergy) {
  VectorX tau;
  dynamics_.InverseDynamics(state_, a_, kGravity, &workspace_, &tau);
  const double rate =
      Rate([this](const auto& s) { return dynamics_.KineticEnergy(s) + dynamics_.PotentialEnergy(s, kGravity); });
  EXPECT_NEAR(tau.dot(v_), rate, 1e-8 * tau.norm());
  MatrixX mass;
  dynamics_.MassMatrix(state_, &workspace_, &mass);
  const double kinetic = 0.5 * v_.dot(mass * v_);
  EXPECT_NEAR(dynamics_.KineticEnergy(state_), kinetic, 1e-12 * kinetic);
}

TEST_P(BodyDynamicsTest, MomentumIsMassTimesTheVelocityOfTheCenterOfMass) {
  const Vector3 v = Rate([this](const auto& s) { return dynamics_.CenterOfMass(s); });
  const Vector3 momentum = dynamics_.LinearMomentum(state_);
  EXPECT_GT(momentum.norm(), 1e-3);
  EXPECT_TRUE(MatrixNear(momentum, dynamics_.total_mass() * v, 1e-8 * dynamics_.total_mass()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, BodyDynamicsTest, ::testing::Values(2, 4, 9, 29));

TEST(BodyDynamics, PendulumInClosedForm) {
  Joint joint;
  joint.name = "hinge";
  joint.link = "rod";
  joint.axis = Vector3::UnitY();
  joint.mass = 2.5;
  joint.center_of_mass = Vector3(0, 0, -0.4);
  joint.inertia = Vector3(0.3, 0.3, 0.01).asDiagonal();
  const Model model = Model::Create({joint}).value();
  const BodyDynamics dynamics(model);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  dynamics.ComputeState(VectorX::Constant(1, 0.7), VectorX::Constant(1, 3.0), &state);
  MatrixX mass;
  VectorX bias;
  dynamics.MassMatrix(state, &workspace, &mass);
  dynamics.BiasForce(state, Vector3(0, 0, -9.81), &workspace, &bias);
  EXPECT_NEAR(mass(0, 0), 0.3 + 2.5 * 0.16, 1e-15);
  EXPECT_NEAR(bias[0], 2.5 * 9.81 * 0.4 * std::sin(0.7), 1e-14);
  EXPECT_NEAR(dynamics.KineticEnergy(state), 0.5 * 0.7 * 9.0, 1e-14);
  EXPECT_NEAR(dynamics.PotentialEnergy(state, Vector3(0, 0, -9.81)), -2.5 * 9.81 * 0.4 * std::cos(0.7), 1e-14);
}

}  // namespace
}  // namespace rollgait
