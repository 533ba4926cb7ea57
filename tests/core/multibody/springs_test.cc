// Springs and dampers of joints: three algorithms against each other, differences and the energy that they hold.
#include <gtest/gtest.h>

#include "core/multibody/body_dynamics.h"
#include "core/multibody/motion_derivatives.h"
#include "core/multibody/tree_dynamics.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::kGravity;
using testing::RandomTree;
using testing::RandomVector;

constexpr int kJoints = 6;

// A revolute joint and a prismatic one with springs, one with a damper alone.
std::vector<Joint> Sprung() {
  std::mt19937 random(3);
  std::vector<Joint> joints = RandomTree(random, kJoints).joints();
  joints[3].stiffness = 40;
  joints[3].rest_position = 0.3;
  joints[3].damping = 2;
  joints[4].stiffness = 70;
  joints[4].rest_position = -0.2;
  joints[5].damping = 5;
  return joints;
}

std::vector<Joint> Unsprung() {
  std::vector<Joint> joints = Sprung();
  for (Joint& joint : joints) joint.stiffness = joint.rest_position = joint.damping = 0;
  return joints;
}

class Springs : public ::testing::Test {
 protected:
  Springs() : random_(11), q_(RandomVector(random_, kJoints)), v_(RandomVector(random_, kJoints, 2)) {}

  VectorX ByTree(const Model& model, const VectorX& q, const VectorX& v) const {
    TreeDynamics tree(model);
    VectorX tau(kJoints);
    tree.Update(q.data(), v.data(), a_.data(), kGravity);
    tree.InverseDynamics(tau.data());
    return tau;
  }

  // What springs and dampers take, by their law.
  VectorX Law(const Model& model) const {
    VectorX taken(kJoints);
    for (int i = 0; i < kJoints; ++i) {
      const Joint& joint = model.joint(i);
      taken(i) = joint.stiffness * (q_(i) - joint.rest_position) + joint.damping * v_(i);
    }
    return taken;
  }

  const Model sprung_ = Model::Create(Sprung()).value(), plain_ = Model::Create(Unsprung()).value();
  std::mt19937 random_;
  const VectorX q_, v_, a_ = VectorX::LinSpaced(kJoints, -3, 4);
};

TEST_F(Springs, TakeTheirLawFromEveryInverseDynamics) {
  const VectorX law = Law(sprung_);
  EXPECT_GT(law.norm(), 10);
  EXPECT_LT((ByTree(sprung_, q_, v_) - ByTree(plain_, q_, v_) - law).norm(), 1e-12 * law.norm());
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  VectorX with, without;
  BodyDynamics(plain_).ComputeState(q_, v_, &state);
  BodyDynamics(plain_).InverseDynamics(state, a_, kGravity, &workspace, &without);
  BodyDynamics(sprung_).InverseDynamics(state, a_, kGravity, &workspace, &with);
  EXPECT_LT((with - without - law).norm(), 1e-12 * law.norm());
  MotionDerivatives motion(sprung_);
  motion.Update(state, v_, a_, kGravity);
  VectorX by_motion;
  motion.InverseDynamics(&by_motion);
  EXPECT_LT((by_motion - with).norm(), 1e-11 * with.norm());
}

TEST_F(Springs, FirstDerivativesMeetDifferences) {
  MatrixX dq = MatrixX::Zero(kJoints, kJoints), dv = dq, da = dq;
  TreeDynamics tree(sprung_);
  tree.Update(q_.data(), v_.data(), a_.data(), kGravity);
  tree.FirstDerivatives(dq, dv, da);
  // As in tree_dynamics_test: 1e-7 of the largest entry.
  const double step = 1e-5, tolerance = 1e-7 * (1 + dq.cwiseAbs().maxCoeff());
  for (int j = 0; j < kJoints; ++j) {
    const VectorX unit = step * VectorX::Unit(kJoints, j);
    const VectorX by_q = (ByTree(sprung_, q_ + unit, v_) - ByTree(sprung_, q_ - unit, v_)) / (2 * step);
    const VectorX by_v = (ByTree(sprung_, q_, v_ + unit) - ByTree(sprung_, q_, v_ - unit)) / (2 * step);
    EXPECT_LT((by_q - dq.col(j)).cwiseAbs().maxCoeff(), tolerance) << j;
    EXPECT_LT((by_v - dv.col(j)).cwiseAbs().maxCoeff(), tolerance) << j;
  }
  BodyDynamics::State state;
  BodyDynamics(sprung_).ComputeState(q_, v_, &state);
  MotionDerivatives motion(sprung_);
  motion.Update(state, v_, a_, kGravity);
  RowMajorMatrix motion_q = RowMajorMatrix::Zero(kJoints, kJoints), motion_v = motion_q;
  motion.InverseDynamics(motion_q, motion_v);
  EXPECT_LT((motion_q - dq).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((motion_v - dv).cwiseAbs().maxCoeff(), tolerance);
}

// Released from anywhere: the energy falls by what the dampers take.
TEST_F(Springs, EnergyFallsByWhatDampersTake) {
  TreeDynamics tree(sprung_);
  const BodyDynamics dynamics(sprung_);
  const VectorX nothing = VectorX::Zero(kJoints);
  VectorX a(kJoints);
  tree.ForwardDynamics(q_.data(), v_.data(), nothing.data(), kGravity, a.data());
  const auto energy = [&](double t) {
    BodyDynamics::State state;
    dynamics.ComputeState(q_ + t * v_ + t * t / 2 * a, v_ + t * a, &state);
    return dynamics.KineticEnergy(state) + dynamics.PotentialEnergy(state, kGravity);
  };
  double taken = 0;
  for (int i = 0; i < kJoints; ++i) taken += sprung_.joint(i).damping * v_(i) * v_(i);
  ASSERT_GT(taken, 0.5);
  // Of the central difference: rounding of some 1e3 J over 2e-6 s, and the third derivative times step² / 6.
  const double step = 1e-6;
  EXPECT_NEAR((energy(step) - energy(-step)) / (2 * step), -taken, 1e-5);
}

TEST_F(Springs, AreRefusedWhereNoSpringIs) {
  const auto refused = [](void (*change)(Joint * joint)) {
    std::vector<Joint> joints = Sprung();
    change(&joints[3]);
    const Result<Model> model = Model::Create(std::move(joints));
    return model.ok() ? "" : model.violations().front().field;
  };
  EXPECT_EQ(refused([](Joint* joint) { joint->stiffness = -1; }), "joints[3].stiffness");
  EXPECT_EQ(refused([](Joint* joint) { joint->damping = kInfinity; }), "joints[3].damping");
  EXPECT_EQ(refused([](Joint* joint) { joint->rest_position = kInfinity; }), "joints[3].rest_position");
  std::vector<Joint> free = Sprung();
  EXPECT_FALSE(Model::Create([&] {
                 free[3].type = JointType::kFree;
                 free[3].actuated = false;
                 free[3].effort_min = free[3].effort_max = 0;
                 return free;
               }())
                   .ok());
}

}  // namespace
}  // namespace rollgait
