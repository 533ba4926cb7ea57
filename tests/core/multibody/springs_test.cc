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

// The damper of a free joint: a couple against the turning of the link relative to its parent, in both algorithms that
// have free joints, with its derivatives.
TEST(FreeDamper, IsACoupleAgainstTheSpin) {
  std::vector<Joint> joints(2);
  for (int i = 0; i < 2; ++i) {
    joints[i].name = i == 0 ? "one" : "two";
    joints[i].type = JointType::kFree;
    joints[i].parent = i - 1;
    joints[i].mass = 2;
    joints[i].center_of_mass = Vector3(0.1, -0.2, 0.05);
    joints[i].inertia = Vector3(0.2, 0.3, 0.4).asDiagonal();
  }
  const Model plain = Model::Create(joints).value();
  const double damping = joints[1].damping = 3;
  const Model damped = Model::Create(joints).value();
  std::mt19937 random(4);
  const VectorX q = RandomVector(random, 14), v = RandomVector(random, 12, 2), a = RandomVector(random, 12, 2);
  VectorX couple = VectorX::Zero(12);
  couple.segment<3>(6) = damping * v.segment<3>(6);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  VectorX with, without;
  BodyDynamics(damped).ComputeState(q, v, &state);
  BodyDynamics(damped).InverseDynamics(state, a, kGravity, &workspace, &with);
  BodyDynamics(plain).InverseDynamics(state, a, kGravity, &workspace, &without);
  EXPECT_LT((with - without - couple).norm(), 1e-13 * with.norm());
  MotionDerivatives motion(damped), bare(plain);
  VectorX by_motion;
  RowMajorMatrix dq = RowMajorMatrix::Zero(12, 12), dv = dq, bare_q = dq, bare_v = dq;
  motion.Update(state, v, a, kGravity);
  motion.InverseDynamics(&by_motion);
  motion.InverseDynamics(dq, dv);
  EXPECT_LT((by_motion - with).norm(), 1e-12 * with.norm());
  bare.Update(state, v, a, kGravity);
  bare.InverseDynamics(bare_q, bare_v);
  EXPECT_EQ(dq, bare_q);
  RowMajorMatrix change = RowMajorMatrix::Zero(12, 12);
  change.diagonal().segment<3>(6).setConstant(damping);
  EXPECT_LT((dv - bare_v - change).norm(), 1e-13 * dv.norm());
}

// An impact lasts no time: what springs and dampers exert in it is no impulse. The next point has them again.
TEST_F(Springs, HaveNoImpulse) {
  TreeDynamics sprung(sprung_), plain(plain_);
  MatrixX mass = MatrixX::Zero(kJoints, kJoints), dq = mass, dv = mass, da = mass, q_plain = mass, v_plain = mass;
  plain.MassMatrix(q_.data(), mass);
  VectorX impulse(kJoints);
  sprung.UpdateImpact(q_.data(), a_.data());
  sprung.InverseDynamics(impulse.data());
  sprung.FirstDerivatives(dq, dv, da);
  EXPECT_LT((impulse - mass * a_).norm(), 1e-13 * impulse.norm());
  EXPECT_LT((da - mass).norm(), 1e-13 * mass.norm());
  plain.UpdateImpact(q_.data(), a_.data());
  plain.FirstDerivatives(q_plain, v_plain, da);
  EXPECT_EQ(dq, q_plain);
  EXPECT_EQ(dv, v_plain);
  sprung.Update(q_.data(), v_.data(), a_.data(), kGravity);
  sprung.InverseDynamics(impulse.data());
  EXPECT_EQ(impulse, ByTree(sprung_, q_, v_));
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
  EXPECT_EQ(refused([](Joint* joint) {
              Joint free;
              free.name = joint->name;
              free.type = JointType::kFree;
              free.parent = joint->parent;
              free.mass = joint->mass;
              free.inertia = joint->inertia;
              free.stiffness = free.damping = 1;
              *joint = free;
            }),
            "joints[3].stiffness");
}

}  // namespace
}  // namespace rollgait
