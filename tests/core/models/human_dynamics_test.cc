// The dynamics of the human by two algorithms that share no code (TreeDynamics, world axes, and BodyDynamics, link
// axes), by energies, and by differences.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/contact/contact_derivatives.h"
#include "core/contact/rolling_kinematics.h"
#include "core/models/catalog.h"
#include "core/multibody/tree_dynamics.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

constexpr int kStates = 1000;
using testing::kGravity;

Scene Human(bool toes) {
  BodyRequest request;
  request.model = "human29";
  request.toes = toes;
  return BuildScene(request).value();
}

struct State {
  VectorX q, v, a;
};

// Postures within the ranges of the joints, and brisk motion.
State RandomState(const Model& model, SeededRandom& random) {
  const int n = model.size();
  State at{VectorX(n), random.VectorOf(n, -3, 3), random.VectorOf(n, -30, 30)};
  for (int j = 0; j < n; ++j) {
    const Joint& joint = model.joint(j);
    at.q(j) = random.Uniform(std::max(joint.position_min, -3.0), std::min(joint.position_max, 3.0));
  }
  return at;
}

class HumanDynamicsTest : public ::testing::TestWithParam<bool> {
 protected:
  Scene scene_ = Human(GetParam());
  int n_ = scene_.model.size();
  BodyDynamics body_{scene_.model};
  BodyDynamics::State state_;
  BodyDynamics::Workspace workspace_;
  TreeDynamics tree_{scene_.model};
  SeededRandom random_{42};
};

TEST_P(HumanDynamicsTest, TwoAlgorithmsAgree) {
  MatrixX mass, dq = MatrixX::Zero(n_, n_), dv = dq, da = dq, only_mass = dq;
  VectorX tau(n_), expected, forward(n_);
  for (int i = 0; i < kStates; ++i) {
    const State at = RandomState(scene_.model, random_);
    tree_.Update(at.q.data(), at.v.data(), at.a.data(), kGravity);
    tree_.InverseDynamics(tau.data());
    tree_.FirstDerivatives(dq, dv, da);
    body_.ComputeState(at.q, at.v, &state_);
    body_.InverseDynamics(state_, at.a, kGravity, &workspace_, &expected);
    body_.MassMatrix(state_, &workspace_, &mass);
    // Rounding of sums over twenty bodies: 1e-16 of the largest term, some hundred times.
    ASSERT_TRUE(MatrixNear(tau, expected, 1e-13 * (1 + expected.cwiseAbs().maxCoeff()))) << i;
    ASSERT_TRUE(MatrixNear(da, mass, 1e-13 * mass.cwiseAbs().maxCoeff())) << i;
    tree_.MassMatrix(at.q.data(), only_mass);
    ASSERT_TRUE(MatrixNear(only_mass, mass, 1e-13 * mass.cwiseAbs().maxCoeff())) << i;
    ASSERT_EQ(mass.llt().info(), Eigen::Success);
    ASSERT_GT(tau.cwiseAbs().maxCoeff(), 10);
    // The accelerations that the inverse dynamics' forces cause are those it started from. The mass matrix has a
    // condition number of 1e5 (75 kg against 1e-3 kg m² of a forearm about its axis).
    tree_.ForwardDynamics(at.q.data(), at.v.data(), expected.data(), kGravity, forward.data());
    ASSERT_TRUE(MatrixNear(forward, at.a, 1e-9 * at.a.cwiseAbs().maxCoeff())) << i;
  }
}

// Energy: ½ vᵀ M v, and power in = change of kinetic and potential energy, along the motion.
TEST_P(HumanDynamicsTest, EnergiesAgree) {
  MatrixX mass;
  VectorX tau;
  for (int i = 0; i < kStates; ++i) {
    const State at = RandomState(scene_.model, random_);
    body_.ComputeState(at.q, at.v, &state_);
    body_.MassMatrix(state_, &workspace_, &mass);
    const double kinetic = body_.KineticEnergy(state_);
    EXPECT_NEAR(0.5 * at.v.dot(mass * at.v), kinetic, 1e-12 * kinetic);
    tree_.Update(at.q.data(), at.v.data(), at.a.data(), kGravity);
    tau.resize(n_);
    tree_.InverseDynamics(tau.data());
    const auto energy = [&](double t) {
      body_.ComputeState(at.q + t * at.v + 0.5 * t * t * at.a, at.v + t * at.a, &state_);
      return body_.KineticEnergy(state_) + body_.PotentialEnergy(state_, kGravity);
    };
    const double h = 1e-4, rate = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    // Truncation h⁴ times a fifth derivative of order (30/s)⁵ J, and rounding 1e-16 of some kJ over h.
    EXPECT_NEAR(rate, tau.dot(at.v), 1e-6 * (1000 + std::abs(rate)));
  }
}

// Contact point, rolling rows and their drift of every foot: derivatives along the tree against the kinematics of one
// body.
TEST_P(HumanDynamicsTest, ContactRowsAgree) {
  std::vector<ContactDerivatives<Dual>> contacts;
  for (const ContactSurface& contact : scene_.contacts) contacts.emplace_back(scene_.model, contact);
  for (int i = 0; i < kStates; ++i) {
    const State at = RandomState(scene_.model, random_);
    tree_.UpdateKinematics(at.q.data(), at.v.data());
    body_.ComputeState(at.q, at.v, &state_);
    for (size_t c = 0; c < contacts.size(); ++c) {
      ContactDerivatives<Dual>& along = contacts[c];
      along.Update(tree_);
      std::vector<Dual> u;
      for (int j : along.path()) u.emplace_back(at.v(j), at.a(j));
      auto field = along.MakeField();
      along.ComputeField(u.data(), &field);
      const RollingContact expected = ComputeRollingContact(scene_.contacts[c], state_);
      MatrixX jacobian = MatrixX::Zero(3, n_);
      RollingJacobian(body_, scene_.contacts[c], state_, expected.p_WP, 0, &jacobian);
      const auto slip = along.Velocity(field);
      Vector3 point, velocity, slip_value, slip_rate;
      for (int d = 0; d < 3; ++d) {
        point(d) = along.point()(d).v;
        velocity(d) = along.point()(d).d;
        slip_value(d) = slip(d).v;
        slip_rate(d) = slip(d).d;
      }
      ASSERT_TRUE(MatrixNear(point, expected.p_WP, 1e-13));
      ASSERT_TRUE(MatrixNear(velocity, expected.point_velocity, 1e-12));
      ASSERT_TRUE(MatrixNear(slip_value, expected.slip, 1e-12));
      ASSERT_TRUE(MatrixNear(slip_rate, jacobian * at.a + expected.drift, 1e-10));  // of some 1000 m/s²
      MatrixX columns = MatrixX::Zero(3, n_);
      for (int k = 0; k < along.path_size(); ++k) {
        for (int d = 0; d < 3; ++d) columns(d, along.path()[k]) = along.JacobianColumn(k)(d).v;
      }
      ASSERT_TRUE(MatrixNear(columns, jacobian, 1e-13));
    }
  }
}

// Central differences, as in tree_dynamics_test, at the human itself.
TEST_P(HumanDynamicsTest, DerivativesMeetDifferences) {
  const int n = n_;
  for (int i = 0; i < 5; ++i) {
    const State at = RandomState(scene_.model, random_);
    const VectorX lambda = random_.VectorOf(n, -1, 1);
    const auto first = [&](const State& s) {
      std::array<MatrixX, 3> d = {MatrixX::Zero(n, n), MatrixX::Zero(n, n), MatrixX::Zero(n, n)};
      tree_.Update(s.q.data(), s.v.data(), s.a.data(), kGravity);
      tree_.FirstDerivatives(d[0], d[1], d[2]);
      return d;
    };
    const auto tau = [&](const State& s) {
      VectorX value(n);
      tree_.Update(s.q.data(), s.v.data(), s.a.data(), kGravity);
      tree_.InverseDynamics(value.data());
      return value;
    };
    const auto d = first(at);
    MatrixX qq = MatrixX::Zero(n, n), qv = qq, qa = qq, vv = qq;
    tree_.Update(at.q.data(), at.v.data(), at.a.data(), kGravity);
    tree_.AddContractedHessian(lambda.data(), qq, qv, qa, vv);
    const double h = 1e-5, scale = 1 + d[0].cwiseAbs().maxCoeff(), scale2 = 1 + qq.cwiseAbs().maxCoeff();
    for (int j = 0; j < n; ++j) {
      State up = at, down = at;
      up.q(j) += h;
      down.q(j) -= h;
      EXPECT_TRUE(MatrixNear((tau(up) - tau(down)) / (2 * h), d[0].col(j), 1e-7 * scale));
      const auto above = first(up), below = first(down);
      EXPECT_TRUE(MatrixNear((above[0] - below[0]).transpose() * lambda / (2 * h), qq.col(j), 1e-7 * scale2));
      EXPECT_TRUE(
          MatrixNear((above[1] - below[1]).transpose() * lambda / (2 * h), qv.row(j).transpose(), 1e-7 * scale2));
      EXPECT_TRUE(
          MatrixNear((above[2] - below[2]).transpose() * lambda / (2 * h), qa.row(j).transpose(), 1e-7 * scale2));
      up.q(j) = down.q(j) = at.q(j);
      up.v(j) += h;
      down.v(j) -= h;
      EXPECT_TRUE(MatrixNear((tau(up) - tau(down)) / (2 * h), d[1].col(j), 1e-7 * scale));
      EXPECT_TRUE(MatrixNear((first(up)[1] - first(down)[1]).transpose() * lambda / (2 * h), vv.col(j), 1e-7 * scale2));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Toes, HumanDynamicsTest, ::testing::Values(false, true));

}  // namespace
}  // namespace rollgait
