// A free joint against the chain of three sliding and three turning joints that moves its link the same way.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <random>

#include "core/multibody/body_dynamics.h"
#include "core/multibody/configuration.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::kGravity;
using testing::RandomTree;
using testing::RandomVector;

constexpr int kArm = 4;  // joints after the floating link

// The arm's joints, attached to the link `base` (which takes the place of the arm's first link).
std::vector<Joint> WithArm(std::vector<Joint> joints, const Model& arm) {
  const int base = static_cast<int>(joints.size()) - 1;
  joints[base].mass = arm.joint(0).mass;
  joints[base].center_of_mass = arm.joint(0).center_of_mass;
  joints[base].inertia = arm.joint(0).inertia;
  for (int i = 1; i < arm.size(); ++i) {
    Joint joint = arm.joint(i);
    joint.parent += base;
    joint.mirror_joint = -1;
    joints.push_back(joint);
  }
  return joints;
}

class FreeJointTest : public ::testing::TestWithParam<int> {
 protected:
  FreeJointTest() : random_(GetParam()) {
    const Model arm = RandomTree(random_, kArm + 1);
    Joint placed;
    placed.p_PJ = RandomVector(random_, 3);
    placed.R_PJ = testing::RandomRotation(random_);
    std::vector<Joint> chain(6, Joint{});
    for (int i = 0; i < 6; ++i) {
      if (i == 0) chain[0] = placed;
      chain[i].name = "chain" + std::to_string(i);
      chain[i].type = i < 3 ? JointType::kPrismatic : JointType::kRevolute;
      chain[i].axis = Vector3::Unit(i < 3 ? i : 5 - i);
      chain[i].parent = i - 1;
    }
    chain_ = std::make_unique<Model>(Model::Create(WithArm(chain, arm)).value());
    placed.name = "free";
    placed.type = JointType::kFree;
    free_ = std::make_unique<Model>(Model::Create(WithArm({placed}, arm)).value());
    q_chain_ = RandomVector(random_, 6 + kArm), v_chain_ = RandomVector(random_, 6 + kArm);
    BodyDynamics(*chain_).ComputeState(q_chain_, v_chain_, &chain_state_);

    // The same pose and twist in the coordinates of the free joint.
    const Matrix3 R_PL = placed.R_PJ.transpose() * chain_state_[5].R_WL;
    const Eigen::Quaterniond rotation(R_PL);
    q_.resize(7 + kArm), v_.resize(6 + kArm);
    // Any length of the quaternion stands for the same rotation.
    q_.head(4) = 1.3 * Eigen::Vector4d(rotation.w(), rotation.x(), rotation.y(), rotation.z());
    q_.segment(4, 3) = placed.R_PJ.transpose() * (chain_state_[5].p_WL - placed.p_PJ);
    v_.head(3) = chain_state_[5].twist.angular, v_.segment(3, 3) = chain_state_[5].twist.linear;
    q_.tail(kArm) = q_chain_.tail(kArm), v_.tail(kArm) = v_chain_.tail(kArm);
    BodyDynamics(*free_).ComputeState(q_, v_, &state_);
    // ∂(twist in link axes)/∂(velocities of the chain).
    MatrixX world = MatrixX::Zero(6, 6 + kArm);
    BodyDynamics(*chain_).AddTwistJacobian(chain_state_, 5, chain_state_[5].p_WL, 1, &world);
    twist_.resize(6, 6);
    twist_.topRows(3) = chain_state_[5].R_WL.transpose() * world.topLeftCorner(3, 6);
    twist_.bottomRows(3) = chain_state_[5].R_WL.transpose() * world.bottomLeftCorner(3, 6);
  }

  std::mt19937 random_;
  std::unique_ptr<Model> chain_, free_;
  VectorX q_chain_, v_chain_, q_, v_;
  BodyDynamics::State chain_state_, state_;
  MatrixX twist_;
};

TEST_P(FreeJointTest, CountsItsCoordinates) {
  EXPECT_EQ(free_->nq(), 7 + kArm);
  EXPECT_EQ(free_->nv(), 6 + kArm);
  EXPECT_EQ(free_->q_index(1), 7);
  EXPECT_EQ(free_->v_index(1), 6);
  EXPECT_TRUE(free_->HasFreeJoint());
  EXPECT_FALSE(chain_->HasFreeJoint());
}

TEST_P(FreeJointTest, MovesEveryLinkLikeTheChain) {
  for (int i = 0; i <= kArm; ++i) {
    EXPECT_TRUE(MatrixNear(state_[i].R_WL, chain_state_[i + 5].R_WL, 1e-13));
    EXPECT_TRUE(MatrixNear(state_[i].p_WL, chain_state_[i + 5].p_WL, 1e-13));
    EXPECT_TRUE(MatrixNear(state_[i].twist.linear, chain_state_[i + 5].twist.linear, 1e-12));
    EXPECT_TRUE(MatrixNear(state_[i].twist.angular, chain_state_[i + 5].twist.angular, 1e-12));
  }
}

TEST_P(FreeJointTest, NeedsTheForcesOfTheChain) {
  const BodyDynamics chain(*chain_), free(*free_);
  BodyDynamics::Workspace workspace;
  const VectorX a_chain = RandomVector(random_, 6 + kArm);
  VectorX tau_chain, tau, a(6 + kArm);
  chain.InverseDynamics(chain_state_, a_chain, kGravity, &workspace, &tau_chain);
  a.head(6) = twist_ * a_chain.head(6);
  a.head(3) += chain_state_[5].bias.angular;
  a.segment(3, 3) += chain_state_[5].bias.linear;
  a.tail(kArm) = a_chain.tail(kArm);
  free.InverseDynamics(state_, a, kGravity, &workspace, &tau);
  EXPECT_TRUE(MatrixNear(twist_.transpose() * tau.head(6), tau_chain.head(6), 1e-11 * tau_chain.norm()));
  EXPECT_TRUE(MatrixNear(tau.tail(kArm), tau_chain.tail(kArm), 1e-11 * tau_chain.norm()));
}

TEST_P(FreeJointTest, MassMatrixIsTheChains) {
  BodyDynamics::Workspace workspace;
  MatrixX mass_chain, mass;
  BodyDynamics(*chain_).MassMatrix(chain_state_, &workspace, &mass_chain);
  BodyDynamics(*free_).MassMatrix(state_, &workspace, &mass);
  MatrixX change = MatrixX::Identity(6 + kArm, 6 + kArm);
  change.topLeftCorner(6, 6) = twist_;
  EXPECT_TRUE(MatrixNear(change.transpose() * mass * change, mass_chain, 1e-11 * mass_chain.norm()));
  EXPECT_NEAR(0.5 * v_.dot(mass * v_), BodyDynamics(*free_).KineticEnergy(state_), 1e-11);
}

TEST_P(FreeJointTest, RetractFollowsThePositionRate) {
  q_.head(4).normalize();
  VectorX rate;
  PositionRate(*free_, q_, v_, &rate);
  const double h = 1e-4;
  const VectorX slope = (8 * (Retract(*free_, q_, h * v_) - Retract(*free_, q_, -h * v_)) -
                         (Retract(*free_, q_, 2 * h * v_) - Retract(*free_, q_, -2 * h * v_))) /
                        (12 * h);
  EXPECT_TRUE(MatrixNear(rate, slope, 1e-10));
  EXPECT_GT(rate.head(4).norm(), 0.01);
  EXPECT_TRUE(MatrixNear(Retract(*free_, q_, VectorX::Zero(6 + kArm)), q_, 1e-15));
  // |q| is kept by the exact flow.
  EXPECT_NEAR(q_.head(4).dot(rate.head(4)), 0, 1e-14);
  VectorX longer = q_;
  longer.head(4) *= 1.25;
  EXPECT_NEAR(NormalizeQuaternions(*free_, &longer), 0.25, 1e-14);
  EXPECT_TRUE(MatrixNear(longer, q_, 1e-15));
}

INSTANTIATE_TEST_SUITE_P(Seeds, FreeJointTest, ::testing::Range(1, 9));

TEST(FreeJoint, RefusesRangesMotorsAndMirrors) {
  Joint joint;
  joint.name = "free", joint.type = JointType::kFree, joint.mass = 1;
  EXPECT_TRUE(Model::Create({joint}).ok());
  Joint ranged = joint;
  ranged.position_min = -1;
  ASSERT_FALSE(Model::Create({ranged}).ok());
  EXPECT_EQ(Model::Create({ranged}).violations()[0].field, "joints[0].position_min");
  Joint driven = joint;
  driven.actuated = true;
  EXPECT_EQ(Model::Create({driven}).violations()[0].field, "joints[0].actuated");
  Joint mirrored = joint;
  mirrored.mirror_sign = -1;
  EXPECT_EQ(Model::Create({mirrored}).violations()[0].field, "joints[0].mirror_joint");
}

}  // namespace
}  // namespace rollgait
