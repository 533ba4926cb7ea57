// Every type of joint with one degree of freedom: dynamics against an independent derivation, in which the row of the
// type is its twist S alone. Poses are products of exp(q S) as power series, forces follow from d'Alembert's principle
// with all derivatives by differences of poses.
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/multibody/body_dynamics.h"
#include "core/multibody/motion_derivatives.h"
#include "core/multibody/tree_dynamics.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using Eigen::Matrix4d;
using testing::kGravity;
using testing::RandomVector;

constexpr int kJoints = 5;

// exp(q S) with S = [turn · u; advance · u].
Matrix4d Exponential(const Joint& joint, double q) {
  Matrix4d twist = Matrix4d::Zero();
  if (joint.kind().turns) twist.topLeftCorner<3, 3>() = Skew(joint.axis);
  twist.topRightCorner<3, 1>() = joint.Advance() * joint.axis;
  Matrix4d sum = Matrix4d::Identity(), term = sum;
  for (int k = 1; k < 60; ++k) sum += term = (term * twist * (q / k)).eval();
  return sum;
}

std::vector<Matrix4d> Poses(const Model& model, const VectorX& q) {
  std::vector<Matrix4d> poses;
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    Matrix4d placed = Matrix4d::Identity();
    placed.topLeftCorner<3, 3>() = joint.R_PJ;
    placed.topRightCorner<3, 1>() = joint.p_PJ;
    const Matrix4d parent =
        joint.parent < 0 ? Matrix4d(Matrix4d::Identity()) : poses[static_cast<size_t>(joint.parent)];
    poses.push_back(parent * placed * Exponential(joint, q(i)));
  }
  return poses;
}

// Where the centres of mass are, as one vector; and the rotations, as one matrix.
VectorX Centers(const Model& model, const VectorX& q) {
  const std::vector<Matrix4d> poses = Poses(model, q);
  VectorX centers(3 * model.size());
  for (int i = 0; i < model.size(); ++i) {
    const Matrix4d& pose = poses[static_cast<size_t>(i)];
    centers.segment<3>(3 * i) =
        pose.topLeftCorner<3, 3>() * model.joint(i).center_of_mass + pose.topRightCorner<3, 1>();
  }
  return centers;
}

MatrixX Rotations(const Model& model, const VectorX& q) {
  const std::vector<Matrix4d> poses = Poses(model, q);
  MatrixX rotations(3, 3 * model.size());
  for (int i = 0; i < model.size(); ++i) {
    rotations.middleCols<3>(3 * i) = poses[static_cast<size_t>(i)].topLeftCorner<3, 3>();
  }
  return rotations;
}

Vector3 Vee(const Matrix3& skew) { return {skew(2, 1), skew(0, 2), skew(1, 0)}; }

// Angular momenta about the centres of mass at time t of the motion q + v t + a t²/2.
VectorX Spins(const Model& model, const VectorX& q, const VectorX& v, const VectorX& a, double t) {
  const auto at = [&](double s) { return Rotations(model, q + v * (t + s) + a * ((t + s) * (t + s) / 2)); };
  const MatrixX rotations = at(0), rates = HighOrderDifference(at, 1e-2);
  VectorX spins(3 * model.size());
  for (int i = 0; i < model.size(); ++i) {
    const Matrix3 R = rotations.middleCols<3>(3 * i);
    spins.segment<3>(3 * i) =
        R * model.joint(i).inertia * R.transpose() * Vee(rates.middleCols<3>(3 * i) * R.transpose());
  }
  return spins;
}

VectorX Independent(const Model& model, const VectorX& q, const VectorX& v, const VectorX& a) {
  const VectorX accelerations =
      HighOrderSecondDifference([&](double t) { return Centers(model, q + v * t + a * (t * t / 2)); }, 2e-2);
  const VectorX moments = HighOrderDifference([&](double t) { return Spins(model, q, v, a, t); }, 1e-2);
  const MatrixX rotations = Rotations(model, q);
  VectorX tau = VectorX::Zero(model.size());
  for (int k = 0; k < model.size(); ++k) {
    const VectorX unit = VectorX::Unit(model.size(), k);
    const VectorX moved = HighOrderDifference([&](double h) { return Centers(model, q + h * unit); }, 1e-2);
    const MatrixX turned = HighOrderDifference([&](double h) { return Rotations(model, q + h * unit); }, 1e-2);
    for (int i = 0; i < model.size(); ++i) {
      const Vector3 turn = Vee(turned.middleCols<3>(3 * i) * rotations.middleCols<3>(3 * i).transpose());
      tau(k) += model.joint(i).mass * (accelerations.segment<3>(3 * i) - kGravity).dot(moved.segment<3>(3 * i)) +
                moments.segment<3>(3 * i).dot(turn);
    }
  }
  return tau;
}

class JointKindsTest : public ::testing::TestWithParam<JointType> {
 protected:
  JointKindsTest() {
    std::vector<Joint> joints = testing::RandomTree(random_, kJoints).joints();
    for (const size_t i : {0, 2, 4}) testing::SetType(GetParam(), &joints[i]);
    model_.emplace(Model::Create(std::move(joints)).value());
    q_ = RandomVector(random_, kJoints), v_ = RandomVector(random_, kJoints), a_ = RandomVector(random_, kJoints, 3);
    lambda_ = RandomVector(random_, kJoints);
  }

  struct Gradients {
    MatrixX q = MatrixX::Zero(kJoints, kJoints), v = q, a = q;
  };
  Gradients At(const VectorX& q, const VectorX& v) const {
    TreeDynamics tree(*model_);
    Gradients gradients;
    tree.Update(q.data(), v.data(), a_.data(), kGravity);
    tree.FirstDerivatives(gradients.q, gradients.v, gradients.a);
    return gradients;
  }

  std::mt19937 random_{5};
  std::optional<Model> model_;
  VectorX q_, v_, a_, lambda_;
};

TEST_P(JointKindsTest, PosesAreExponentialsOfTheTwist) {
  const std::vector<Matrix4d> poses = Poses(*model_, q_);
  TreeDynamics tree(*model_);
  tree.UpdateKinematics(q_.data(), v_.data());
  BodyDynamics::State state;
  BodyDynamics(*model_).ComputeState(q_, v_, &state);
  for (int i = 0; i < kJoints; ++i) {
    const auto at = static_cast<size_t>(i);
    const Matrix3 R = poses[at].topLeftCorner<3, 3>();
    const Vector3 p = poses[at].topRightCorner<3, 1>();
    EXPECT_TRUE(MatrixNear(tree.rotation(i), R, 1e-13)) << i;
    EXPECT_TRUE(MatrixNear(tree.origin(i), p, 1e-13)) << i;
    EXPECT_TRUE(MatrixNear(state[at].R_WL, R, 1e-13)) << i;
    EXPECT_TRUE(MatrixNear(state[at].p_WL, p, 1e-13)) << i;
  }
}

// Three algorithms against the fourth, whose differences have errors of about 1e-11 of its terms.
TEST_P(JointKindsTest, InverseDynamicsIsThatOfDAlembert) {
  const VectorX expected = Independent(*model_, q_, v_, a_);
  VectorX tau(kJoints);
  TreeDynamics tree(*model_);
  tree.Update(q_.data(), v_.data(), a_.data(), kGravity);
  tree.InverseDynamics(tau.data());
  EXPECT_TRUE(MatrixNear(tau, expected, 1e-8));
  const BodyDynamics dynamics(*model_);
  BodyDynamics::State state;
  BodyDynamics::Workspace workspace;
  dynamics.ComputeState(q_, v_, &state);
  dynamics.InverseDynamics(state, a_, kGravity, &workspace, &tau);
  EXPECT_TRUE(MatrixNear(tau, expected, 1e-8));
  MotionDerivatives motion(*model_);
  motion.Update(state, v_, a_, kGravity);
  motion.InverseDynamics(&tau);
  EXPECT_TRUE(MatrixNear(tau, expected, 1e-8));
  MatrixX mass;
  dynamics.MassMatrix(state, &workspace, &mass);
  EXPECT_TRUE(MatrixNear(mass, At(q_, v_).a, 1e-11));
  EXPECT_GT(expected.cwiseAbs().minCoeff(), 1e-2);
}

// By differences of the independent derivation, whose own errors leave 1e-6; the two algorithms agree to rounding.
TEST_P(JointKindsTest, FirstDerivativesAreThoseOfDAlembert) {
  const Gradients gradients = At(q_, v_);
  for (int j = 0; j < kJoints; ++j) {
    const VectorX unit = VectorX::Unit(kJoints, j);
    const VectorX by_q =
        HighOrderDifference([&](double h) { return Independent(*model_, q_ + h * unit, v_, a_); }, 2e-2);
    const VectorX by_v =
        HighOrderDifference([&](double h) { return Independent(*model_, q_, v_ + h * unit, a_); }, 2e-2);
    EXPECT_TRUE(MatrixNear(gradients.q.col(j), by_q, 1e-6)) << j;
    EXPECT_TRUE(MatrixNear(gradients.v.col(j), by_v, 1e-6)) << j;
  }
  BodyDynamics::State state;
  BodyDynamics(*model_).ComputeState(q_, v_, &state);
  MotionDerivatives motion(*model_);
  motion.Update(state, v_, a_, kGravity);
  RowMajorMatrix dq = RowMajorMatrix::Zero(kJoints, kJoints), dv = dq;
  motion.InverseDynamics(dq, dv);
  EXPECT_TRUE(MatrixNear(MatrixX(dq), gradients.q, 1e-11));
  EXPECT_TRUE(MatrixNear(MatrixX(dv), gradients.v, 1e-11));
}

TEST_P(JointKindsTest, SecondDerivativesMeetDifferencesOfTheFirst) {
  MatrixX qq = MatrixX::Zero(kJoints, kJoints), qv = qq, qa = qq, vv = qq;
  TreeDynamics tree(*model_);
  tree.Update(q_.data(), v_.data(), a_.data(), kGravity);
  tree.AddContractedHessian(lambda_.data(), qq, qv, qa, vv);
  for (int j = 0; j < kJoints; ++j) {
    const VectorX unit = VectorX::Unit(kJoints, j);
    const auto along_q = [&](auto member) {
      return VectorX(HighOrderDifference(
          [&](double h) { return VectorX((At(q_ + h * unit, v_).*member).transpose() * lambda_); }, 1e-2));
    };
    EXPECT_TRUE(MatrixNear(qq.col(j), along_q(&Gradients::q), 1e-10)) << j;
    EXPECT_TRUE(MatrixNear(VectorX(qv.row(j).transpose()), along_q(&Gradients::v), 1e-10)) << j;
    EXPECT_TRUE(MatrixNear(VectorX(qa.row(j).transpose()), along_q(&Gradients::a), 1e-10)) << j;
    const VectorX by_v =
        HighOrderDifference([&](double h) { return VectorX(At(q_, v_ + h * unit).v.transpose() * lambda_); }, 1e-2);
    EXPECT_TRUE(MatrixNear(vv.col(j), by_v, 1e-10)) << j;
  }
  EXPECT_GT(qq.norm(), 0.1);
}

std::string WordOf(const ::testing::TestParamInfo<JointType>& info) { return KindOf(info.param).word; }
INSTANTIATE_TEST_SUITE_P(Types, JointKindsTest, ::testing::ValuesIn(testing::OneDegreeTypes()), WordOf);

TEST(JointKinds, RowsAreInTheOrderOfTheEnumeration) {
  for (size_t i = 0; i < std::size(kJointKinds); ++i) {
    EXPECT_EQ(static_cast<size_t>(kJointKinds[i].type), i);
    EXPECT_EQ(FindJointKind(kJointKinds[i].name), &kJointKinds[i]);
  }
  EXPECT_EQ(FindJointKind("TYPE_UNSPECIFIED"), nullptr);
}

}  // namespace
}  // namespace rollgait
