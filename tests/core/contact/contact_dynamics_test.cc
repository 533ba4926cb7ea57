#include "core/contact/contact_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "core/contact/impact.h"
#include "core/multibody/configuration.h"
#include "tests/support/contact_tree.h"
#include "tests/support/matrix_near.h"
#include "tests/support/standing_box.h"
#include "tests/support/standing_plate.h"

namespace rollgait {
namespace {

using testing::RandomVector;

const Vector3 kGravity(1.1, -0.6, -9.3);

class ContactDynamicsTest : public ::testing::TestWithParam<int> {
 protected:
  ContactDynamicsTest()
      : tree_(static_cast<unsigned>(GetParam())),
        random_(tree_.random),
        model_(tree_.model),
        dynamics_(BodyDynamics(model_), tree_.contacts),
        q_(tree_.q),
        v_(tree_.v),
        ground_(tree_.ground) {
    dynamics_.SetState(q_, v_, ground_);
  }

  // Moves for a time h with accelerations a and the ground's full motion; what the velocities are then.
  void Move(double h, const VectorX& a) {
    const VectorX v = v_ + h * a;
    const VectorX q = Retract(model_, q_, h * v_ + 0.5 * h * h * a);
    std::vector<FrameMotion> ground = ground_;
    FrameMotion& g = ground[1];
    const FrameMotion& g0 = ground_[1];
    const Vector3 turn = h * g0.w_WB + 0.5 * h * h * g0.alpha_WB;
    g.R_WB = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * g0.R_WB;
    g.p_WB = g0.p_WB + h * g0.v_WB + 0.5 * h * h * g0.a_WB;
    g.w_WB = g0.w_WB + h * g0.alpha_WB;
    g.v_WB = g0.v_WB + h * g0.a_WB;
    dynamics_.SetState(q, v, ground);
  }

  testing::ContactTree tree_;
  std::mt19937& random_;
  const Model& model_;
  ContactDynamics dynamics_;
  VectorX& q_;
  VectorX& v_;
  const std::vector<FrameMotion>& ground_;
};

// The equations of motion with the forces that come out, by inverse dynamics, and the constraints.
TEST_P(ContactDynamicsTest, AccelerationsAndForcesBelongTogether) {
  const VectorX tau = RandomVector(random_, model_.nv());
  const std::vector<int> active = {0, 1, 2, 3};
  const ConstrainedSolution solution = dynamics_.Accelerate(active, tau, kGravity, {});
  EXPECT_EQ(solution.rank, 10);
  EXPECT_FALSE(solution.redundant);
  EXPECT_LT(solution.residual, 1e-9);
  BodyDynamics::Workspace workspace;
  VectorX needed;
  dynamics_.dynamics().InverseDynamics(dynamics_.state(), solution.acceleration, kGravity, &workspace, &needed);
  VectorX given = tau;
  MatrixX linear, angular;
  for (int k = 0; k < 4; ++k) {
    dynamics_.SlipJacobian(k, &linear, &angular);
    given += linear.transpose() * dynamics_.Force(k);
    given += angular.transpose() * dynamics_.Kinematics(k).normal * dynamics_.SpinTorque(k);
    EXPECT_GT(dynamics_.Force(k).norm(), 1e-3);
  }
  EXPECT_GT(std::abs(dynamics_.SpinTorque(0)), 1e-6);
  EXPECT_TRUE(MatrixNear(given, needed, 1e-8 * needed.norm()));
  // A frictionless contact pushes along its normal only.
  EXPECT_LT(dynamics_.Force(1).cross(dynamics_.Kinematics(1).normal).norm(), 1e-10 * dynamics_.Force(1).norm());
}

// The Jacobian against the slip, with body 2 standing still or not: it is linear in v.
TEST_P(ContactDynamicsTest, SlipIsItsJacobianTimesTheVelocity) {
  MatrixX linear, angular;
  for (int k = 0; k < 4; ++k) {
    dynamics_.SetState(q_, v_, ground_);
    const Vector3 slip = dynamics_.Kinematics(k).slip;
    const double spin = dynamics_.Spin(k);
    dynamics_.SlipJacobian(k, &linear, &angular);
    const Vector3 n = dynamics_.Kinematics(k).normal;
    dynamics_.SetState(q_, VectorX::Zero(model_.nv()), ground_);
    EXPECT_TRUE(MatrixNear(linear * v_, slip - dynamics_.Kinematics(k).slip, 1e-12));
    EXPECT_NEAR(n.dot(angular * v_), spin - dynamics_.Spin(k), 1e-12);
  }
}

// Along the accelerated motion the held velocities keep the values they have (bilateral, no Baumgarte): their rate by
// differences of order 4 is zero for the rolling and the spin rows up to what turning rows add, which is zero without
// slip.
TEST_P(ContactDynamicsTest, HeldVelocitiesStayHeld) {
  // First a state without slip: the velocity of least energy change.
  const std::vector<int> active = {0, 1, 2, 3};
  const Impact impact = ResolveImpact(active, active, &dynamics_);
  v_ = impact.velocity;
  dynamics_.SetState(q_, v_, ground_);
  MatrixX rows;
  VectorX rate;
  dynamics_.VelocityRows(active, &rows, &rate);
  EXPECT_LT(rate.cwiseAbs().maxCoeff(), 1e-10);
  const VectorX a = dynamics_.Accelerate(active, RandomVector(random_, model_.nv()), kGravity, {}).acceleration;
  const double h = 1e-3 / (1 + a.norm());
  const auto rate_at = [&](double time) {
    Move(time, a);
    dynamics_.VelocityRows(active, &rows, &rate);
    return rate;
  };
  const VectorX near = rate_at(h), minus_near = rate_at(-h), far = rate_at(2 * h), minus_far = rate_at(-2 * h);
  const VectorX slope = (8 * (near - minus_near) - (far - minus_far)) / (12 * h);
  EXPECT_LT(slope.cwiseAbs().maxCoeff(), 1e-6 * (1 + a.norm())) << slope.transpose();
}

TEST_P(ContactDynamicsTest, BaumgarteAddsItsTerms) {
  Baumgarte terms;
  terms.frequency = 3, terms.damping = 0.7, terms.slip_rate = 5;
  MatrixX rows;
  VectorX plain, with;
  dynamics_.AccelerationRows({0, 1, 2, 3}, {}, &rows, &plain);
  dynamics_.AccelerationRows({0, 1, 2, 3}, terms, &rows, &with);
  const PairKinematics pair = dynamics_.Kinematics(0);
  const double normal = -2 * 0.7 * 3 * pair.gap_rate - 9 * pair.gap;
  const Vector3 tangential = -5 * (pair.slip - pair.normal * pair.normal.dot(pair.slip));
  EXPECT_TRUE(MatrixNear((with - plain).head(3), normal * pair.normal + tangential, 1e-10));
  EXPECT_NEAR((with - plain)[3], -5 * dynamics_.Spin(0), 1e-10);
  EXPECT_NEAR((with - plain)[4], -2 * 0.7 * 3 * dynamics_.Kinematics(1).gap_rate - 9 * dynamics_.Kinematics(1).gap,
              1e-10);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ContactDynamicsTest, ::testing::Range(1, 7));

// A box that stands on four frictional points: more rows than it can move. Accelerations are right, forces balance.
TEST(ContactDynamics, RedundantContactsGiveTheRightAcceleration) {
  testing::StandingBox box(Vector3(0.1, 0.1, 0.1));
  ContactDynamics& dynamics = box.dynamics;
  const ConstrainedSolution& solution = dynamics.Accelerate({0, 1, 2, 3}, VectorX::Zero(6), Vector3(1, 0, -9.81), {});
  EXPECT_TRUE(solution.redundant);
  EXPECT_EQ(solution.rank, 6);
  EXPECT_LT(solution.acceleration.cwiseAbs().maxCoeff(), 1e-12);
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 4; ++k) sum += dynamics.Force(k);
  EXPECT_TRUE(MatrixNear(sum, Vector3(-2, 0, 2 * 9.81), 1e-11));
}

// Three feet, the third δ off the line of the others, and a weight 0.3 m beside it: the forces are huge, and exact to
// what `independence` says; where no digit is left of them, that is reported.
TEST(ContactDynamics, NearlyRedundantContactsSayHowManyDigitsAreLeft) {
  const double weight = 3 * 9.81, epsilon = 2.2e-16;
  for (int e = 0; e >= -15; --e) {
    const double delta = std::pow(10, e), off = 0.3;
    testing::StandingPlate plate({{-1, off - delta / 3, 0}, {1, off - delta / 3, 0}, {0, off + 2 * delta / 3, 0}},
                                 Grip::kFrictionless);
    const ConstrainedSolution& solution =
        plate.dynamics.Accelerate(plate.active, VectorX::Zero(6), Vector3(0, 0, -9.81), {});
    EXPECT_EQ(solution.redundant, e <= -11) << e;
    EXPECT_EQ(solution.ForcesUnique(), e > -8) << e;
    if (e <= -11) continue;  // the body falls about the line, as it does for δ = 0
    const double last = -weight * (off - delta / 3) / delta, others = (weight - last) / 2;
    const double lost = 20 * epsilon / solution.independence;
    EXPECT_LT(solution.acceleration.cwiseAbs().maxCoeff(), 9.81 * lost) << e;
    EXPECT_TRUE(
        MatrixNear(solution.forces, Vector3(others, others, last), lost / solution.independence * std::abs(last)))
        << e;
    EXPECT_GT(solution.independence, 0.5 * delta);
    EXPECT_LT(solution.independence, 2 * delta);
  }
}

// A rod of half length 1 that turns about its left end onto its right one. With I > m the left end would have to be
// held down, so it is let go and rises; with I < m it would go into the ground, so both ends are held.
TEST(Impact, HoldsWhatPushesAndReleasesWhatWouldPull) {
  std::vector<Joint> joints(3);
  joints[0].name = "x", joints[0].type = JointType::kPrismatic, joints[0].axis = Vector3::UnitX();
  joints[1].name = "z", joints[1].type = JointType::kPrismatic, joints[1].axis = Vector3::UnitZ(), joints[1].parent = 0;
  joints[2].name = "turn", joints[2].axis = -Vector3::UnitY(), joints[2].parent = 1, joints[2].mass = 1;
  for (const double moment : {0.1, 3.0}) {
    joints[2].inertia = Vector3(moment, moment, 0).asDiagonal();
    const Model model = Model::Create(joints).value();
    std::vector<TreeContact> contacts(2);
    for (int k = 0; k < 2; ++k) {
      contacts[static_cast<size_t>(k)].link = 2;
      contacts[static_cast<size_t>(k)].surface = {Sphere(1e-12), Vector3(k == 0 ? -1 : 1, 0, 0), Matrix3::Identity()};
      contacts[static_cast<size_t>(k)].grip = Grip::kRollingAlong;
    }
    ContactDynamics dynamics(BodyDynamics(model), contacts);
    // Turning about the left end, the right one falls at 2 m/s.
    dynamics.SetState(VectorX::Zero(3), Vector3(0, -1, -1), {FrameMotion{}});
    EXPECT_NEAR(dynamics.Kinematics(0).slip.norm(), 0, 1e-11);
    const Impact impact = ResolveImpact({0, 1}, {1}, &dynamics);
    EXPECT_TRUE(impact.consistent);
    if (moment > 1) {
      EXPECT_EQ(impact.held, std::vector<int>{1});
      EXPECT_EQ(impact.released, std::vector<int>{0});
      EXPECT_GT(impact.gap_rates[0], 0);
      // Angular momentum about the right end is kept: −m v l + I ω = (I + m) ω⁺ with v = ω = −1 about the left end.
      EXPECT_NEAR(impact.velocity[2], (1 - moment) / (moment + 1), 1e-12);
    } else {
      EXPECT_EQ(impact.held, (std::vector<int>{0, 1}));
      EXPECT_GT(impact.impulses[0].z(), 0);
      EXPECT_LT(impact.velocity.norm(), 1e-12);
    }
    EXPECT_GT(impact.energy_loss, 0);
    const VectorX before = Vector3(0, -1, -1);
    const MatrixX mass = dynamics.MassMatrix();
    EXPECT_NEAR(impact.energy_loss, 0.5 * before.dot(mass * before) - 0.5 * impact.velocity.dot(mass * impact.velocity),
                1e-12);
  }
}

}  // namespace
}  // namespace rollgait
