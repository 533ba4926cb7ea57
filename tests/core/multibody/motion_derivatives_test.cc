#include "core/multibody/motion_derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "core/multibody/configuration.h"
#include "core/multibody/tree_dynamics.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::kGravity;
using testing::RandomVector;

class MotionDerivativesTest : public ::testing::TestWithParam<unsigned> {
 protected:
  // Two of the joints free: one at the root, one that hangs on another link.
  Model WithFreeJoints() {
    std::vector<Joint> joints = testing::RandomTree(random_, 6).joints();
    for (Joint& joint : joints) {
      joint.mirror_joint = -1;
      joint.mass = std::max(joint.mass, 0.5);
      if (joint.inertia.isZero()) joint.inertia = Vector3(0.2, 0.3, 0.4).asDiagonal();
    }
    joints[3].parent = 2;
    for (const size_t i : {0, 3}) {
      joints[i].type = JointType::kFree;
      joints[i].actuated = false;
      joints[i].effort_min = joints[i].effort_max = 0;
    }
    return Model::Create(std::move(joints)).value();
  }
  std::mt19937 random_{GetParam()};
};

TEST_P(MotionDerivativesTest, InverseDynamicsMeetsDifferences) {
  const Model model = WithFreeJoints();
  const BodyDynamics dynamics(model);
  const int nv = model.nv();
  const VectorX q = Retract(model, NeutralConfiguration(model), RandomVector(random_, nv));
  const VectorX v = RandomVector(random_, nv, 2), a = RandomVector(random_, nv, 5);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  const auto tau = [&](const VectorX& q_at, const VectorX& v_at) {
    VectorX result;
    dynamics.ComputeState(q_at, v_at, &state);
    dynamics.InverseDynamics(state, a, kGravity, &workspace, &result);
    return result;
  };
  dynamics.ComputeState(q, v, &state);
  MotionDerivatives motion(model);
  motion.Update(state, v, a, kGravity);
  RowMajorMatrix dq = RowMajorMatrix::Zero(nv, nv), dv = dq;
  motion.InverseDynamics(dq, dv);
  for (int j = 0; j < nv; ++j) {
    const VectorX unit = VectorX::Unit(nv, j);
    const VectorX by_q = HighOrderDifference([&](double h) { return tau(Retract(model, q, h * unit), v); }, 1e-2);
    const VectorX by_v = HighOrderDifference([&](double h) { return tau(q, v + h * unit); }, 1e-2);
    EXPECT_TRUE(MatrixNear(dq.col(j), by_q, 1e-11 * (1 + dq.norm()))) << j;
    EXPECT_TRUE(MatrixNear(dv.col(j), by_v, 1e-11 * (1 + dv.norm()))) << j;
  }
  EXPECT_GT(dv.norm(), 1);
}

// Origin, twist and acceleration of every link; those of the links that a column does not move stay.
TEST_P(MotionDerivativesTest, LinksMeetDifferences) {
  const Model model = WithFreeJoints();
  const BodyDynamics dynamics(model);
  const int nv = model.nv();
  const VectorX q = Retract(model, NeutralConfiguration(model), RandomVector(random_, nv));
  const VectorX v = RandomVector(random_, nv, 2), a = RandomVector(random_, nv, 5);
  BodyDynamics::State state;
  MotionDerivatives motion(model), moved(model);
  dynamics.ComputeState(q, v, &state);
  motion.Update(state, v, a, kGravity);
  for (int link = 0; link < model.size(); ++link) {
    const auto stacked = [&](const VectorX& q_at, const VectorX& v_at) {
      BodyDynamics::State at;
      dynamics.ComputeState(q_at, v_at, &at);
      moved.Update(at, v_at, a, kGravity);
      const MotionDerivatives::PointMotion o = moved.Origin(link);
      VectorX all(15);
      all << at[static_cast<size_t>(link)].p_WL, o.w, o.v, o.alpha, o.a;
      return all;
    };
    const auto stack = [](const MotionDerivatives::Change& change) {
      VectorX all(15);
      all << change.shift, change.motion.w, change.motion.v, change.motion.alpha, change.motion.a;
      return all;
    };
    for (int j : motion.path(link)) {
      const VectorX unit = VectorX::Unit(nv, j);
      const VectorX by_q = HighOrderDifference([&](double h) { return stacked(Retract(model, q, h * unit), v); }, 1e-2);
      const VectorX by_v = HighOrderDifference([&](double h) { return stacked(q, v + h * unit); }, 1e-2);
      EXPECT_TRUE(MatrixNear(stack(motion.AlongPosition(link, j)), by_q, 1e-10 * (1 + by_q.norm()))) << link;
      EXPECT_TRUE(MatrixNear(stack(motion.AlongVelocity(link, j)), by_v, 1e-10 * (1 + by_v.norm()))) << link;
    }
  }
}

// The two derivations of the library, on a tree that both take.
TEST_P(MotionDerivativesTest, AgreesWithTreeDynamics) {
  const Model model = testing::RandomTree(random_, 9);
  const BodyDynamics dynamics(model);
  const VectorX q = RandomVector(random_, 9), v = RandomVector(random_, 9, 2), a = RandomVector(random_, 9, 5);
  BodyDynamics::State state;
  dynamics.ComputeState(q, v, &state);
  MotionDerivatives motion(model);
  motion.Update(state, v, a, kGravity);
  RowMajorMatrix dq = RowMajorMatrix::Zero(9, 9), dv = dq;
  MatrixX expected_q = MatrixX::Zero(9, 9), expected_v = expected_q, mass = expected_q;
  motion.InverseDynamics(dq, dv);
  TreeDynamics tree(model);
  tree.Update(q.data(), v.data(), a.data(), kGravity);
  tree.FirstDerivatives(expected_q, expected_v, mass);
  EXPECT_TRUE(MatrixNear(dq, expected_q, 1e-12 * expected_q.norm()));
  EXPECT_TRUE(MatrixNear(dv, expected_v, 1e-12 * expected_v.norm()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, MotionDerivativesTest, ::testing::Range(1u, 6u));

}  // namespace
}  // namespace rollgait
