// Ball and universal joints as chains: where they lose a direction, and that they move a body as mechanics says.
#include "core/models/joint_chain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/multibody/tree_dynamics.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

constexpr double kPi = std::numbers::pi;

// A link on revolute joints about these axes through one point of the world.
std::vector<Joint> Chain(const std::vector<Vector3>& axes, std::mt19937& random) {
  std::vector<Joint> joints(axes.size());
  for (size_t i = 0; i < axes.size(); ++i) {
    joints[i].name = "turn" + std::to_string(i);
    joints[i].parent = static_cast<int>(i) - 1;
    joints[i].axis = axes[i].normalized();
  }
  joints[0].p_PJ = testing::RandomVector(random, 3);
  joints[0].R_PJ = testing::RandomRotation(random);
  Joint& last = joints.back();
  last.mass = 2.3;
  last.center_of_mass = testing::RandomVector(random, 3);
  const Matrix3 R = testing::RandomRotation(random);
  last.inertia = R * Vector3(0.5, 0.7, 1.1).asDiagonal() * R.transpose();
  last.inertia = (0.5 * (last.inertia + last.inertia.transpose())).eval();
  return joints;
}

JointChain Told(const std::vector<Joint>& joints) { return {"ball", &kChainKinds[joints.size() == 3 ? 1 : 0], 0}; }

std::vector<Vector3> RandomAxes(std::mt19937& random, int n) {
  std::vector<Vector3> axes;
  while (static_cast<int>(axes.size()) < n) {
    const Vector3 axis = Vector3(testing::RandomVector(random, 3)).normalized();
    if (axes.empty() || axes.back().cross(axis).norm() > 0.3) axes.push_back(axis);
  }
  return axes;
}

// Of the link in the frame of the first joint, by rotations alone.
Matrix3 RotationAt(const std::vector<Joint>& joints, const VectorX& q) {
  Matrix3 R = Matrix3::Identity();
  for (size_t i = 0; i < joints.size(); ++i) {
    R = R * Eigen::AngleAxisd(q(static_cast<int>(i)), joints[i].axis).toRotationMatrix();
  }
  return R;
}

// ω in link axes of a rotation's rate.
Vector3 Spin(const Matrix3& R, const Matrix3& rate) {
  const Matrix3 skew = R.transpose() * rate;
  return {skew(2, 1), skew(0, 2), skew(1, 0)};
}

// Columns of ω = J q̇ in link axes, by central differences of rotations.
MatrixX SpinJacobian(const std::vector<Joint>& joints, const VectorX& q) {
  constexpr double kStep = 1e-5;
  MatrixX J(3, q.size());
  for (int k = 0; k < q.size(); ++k) {
    const VectorX step = kStep * VectorX::Unit(q.size(), k);
    const Matrix3 rate = (RotationAt(joints, q + step) - RotationAt(joints, q - step)) / (2 * kStep);
    J.col(k) = Spin(RotationAt(joints, q), rate);
  }
  return J;
}

bool IsRange(const std::vector<Joint>& joints, double min, double max) {
  return RangeProblem({Told(joints)}, joints, 1, min, max).empty();
}

// The bounds of the message hold where the three columns of differences are dependent, for axes of any direction.
TEST(JointChain, TheMiddleTurnStaysAwayFromWhereTheJointLosesADirection) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Joint> joints = Chain(RandomAxes(random, 3), random);
    VectorX q = testing::RandomVector(random, 3, 3);
    const auto volume = [&](double middle) {
      q(1) = middle;
      return SpinJacobian(joints, q).determinant();
    };
    // Zeros of the volume by bisection between places of opposite signs, half a turn apart.
    double a = 0.3, b = 0.3 + kPi;
    ASSERT_LT(volume(a) * volume(b), 0);
    for (int i = 0; i < 40; ++i) {
      const double middle = (a + b) / 2;
      (volume(a) * volume(middle) <= 0 ? b : a) = middle;
    }
    const double singular = (a + b) / 2, ten = 10 * kPi / 180;
    EXPECT_TRUE(IsRange(joints, singular + ten, singular + kPi - ten));
    EXPECT_TRUE(IsRange(joints, singular - kPi + ten, singular - ten));
    EXPECT_FALSE(IsRange(joints, singular + ten - 1e-3, singular + kPi - ten));
    EXPECT_FALSE(IsRange(joints, singular + ten, singular + kPi - ten + 1e-3));
    EXPECT_FALSE(IsRange(joints, singular - 0.2, singular + 0.2));
    EXPECT_FALSE(IsRange(joints, -kInfinity, kInfinity));
    EXPECT_EQ(RangeProblem({Told(joints)}, joints, 0, -9, 9), "");
    EXPECT_EQ(RangeProblem({Told(joints)}, joints, 2, -9, 9), "");
  }
}

// Two axes that are not parallel stay so, whatever the position: a universal joint has no singularity.
TEST(JointChain, AUniversalJointKeepsTheAngleOfItsAxes) {
  std::mt19937 random(5);
  const std::vector<Joint> joints = Chain(RandomAxes(random, 2), random);
  const double sine = joints[0].axis.cross(joints[1].axis).norm();
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixX J = SpinJacobian(joints, testing::RandomVector(random, 2, 3));
    EXPECT_NEAR(Vector3(J.col(0)).cross(Vector3(J.col(1))).norm(), sine, 1e-9);
  }
  EXPECT_EQ(RangeProblem({Told(joints)}, joints, 1, -9, 9), "");
}

TEST(JointChain, AxesThatAreAlmostParallelAreNamed) {
  std::mt19937 random(6);
  const double nine = 9 * kPi / 180, eleven = 11 * kPi / 180;
  int joint = 0;
  for (const double sign : {1.0, -1.0}) {
    const auto axes = [&](double angle) {
      return std::vector<Vector3>{Vector3::UnitY(), Vector3::UnitX(),
                                  Vector3(sign * std::cos(angle), std::sin(angle), 0)};
    };
    EXPECT_NE(AxesProblem(Told(Chain(axes(nine), random)), Chain(axes(nine), random), &joint), "");
    EXPECT_EQ(joint, 2);
    EXPECT_EQ(AxesProblem(Told(Chain(axes(eleven), random)), Chain(axes(eleven), random), &joint), "");
  }
}

// Euler's equations of a body that is held at a point, with ω and its rate from differences of rotations along
// q + v t + a t²/2: the moment of the joint along each axis is the effort of the coordinate.
TEST(JointChain, MovesABodyAsEulersEquationsSay) {
  std::mt19937 random(7);
  for (const int n : {2, 3}) {
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Joint> joints = Chain(RandomAxes(random, n), random);
      const Model model = Model::Create(joints).value();
      TreeDynamics dynamics(model);
      const VectorX q = testing::RandomVector(random, n, 2), v = testing::RandomVector(random, n, 3);
      const VectorX a = testing::RandomVector(random, n, 5);
      dynamics.Update(q.data(), v.data(), a.data(), testing::kGravity);
      VectorX tau(n);
      dynamics.InverseDynamics(tau.data());

      const auto at = [&](double t) { return RotationAt(joints, q + v * t + a * (t * t / 2)); };
      // Step of second differences: error h² and rounding 1e-16/h² meet near 1e-8.
      constexpr double kStep = 1e-4;
      const Matrix3 R = at(0), before = at(-kStep), after = at(kStep);
      const Matrix3 rate = (after - before) / (2 * kStep);
      const Matrix3 second = (after - 2 * R + before) / (kStep * kStep);
      const Vector3 spin = Spin(R, rate);
      // RᵀR̈ = ω̇× + ω×ω×, whose skew part is the first.
      const Matrix3 skew = 0.5 * (R.transpose() * second - second.transpose() * R);
      const Vector3 acceleration(skew(2, 1), skew(0, 2), skew(1, 0));
      const Joint& last = joints.back();
      const Vector3& c = last.center_of_mass;
      const Matrix3 about_point =
          last.inertia + last.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
      const Vector3 gravity = (joints[0].R_PJ * R).transpose() * testing::kGravity;
      const Vector3 moment = about_point * acceleration + spin.cross(about_point * spin) - last.mass * c.cross(gravity);
      const VectorX expected = SpinJacobian(joints, q).transpose() * moment;
      EXPECT_LT((tau - expected).norm(), 1e-5 * (1 + tau.norm())) << n;
      EXPECT_GT(tau.norm(), 0.1);
    }
  }
}

TEST(JointChain, PathsAreThoseOfTheMessage) {
  // Joints of the tree: 0, ball 1 2 3, 4, universal 5 6, 7; of the message: 0, 1, 2, 3, 4.
  const std::vector<JointChain> chains = {{"ball", &kChainKinds[1], 1}, {"universal", &kChainKinds[0], 5}};
  const int index[] = {0, 1, 1, 1, 2, 3, 3, 4};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(MessageIndex(chains, i), index[i]) << i;
  EXPECT_EQ(MessageIndex(chains, -1), -1);
  EXPECT_EQ(JointPath(chains, 0, "axis"), "joints[0].axis");
  EXPECT_EQ(JointPath(chains, 2, "axis"), "joints[1].coordinates[1].axis");
  EXPECT_EQ(JointPath(chains, 2, "link_name"), "joints[1].coordinates[1].name");
  EXPECT_EQ(JointPath(chains, 3, "link_name"), "joints[1].link_name");
  EXPECT_EQ(JointPath(chains, 6, "mass_kg"), "joints[3].mass_kg");
  EXPECT_EQ(JointPath(chains, 7, "mass_kg"), "joints[4].mass_kg");
}

}  // namespace
}  // namespace rollgait
