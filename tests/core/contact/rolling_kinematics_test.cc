#include "core/contact/rolling_kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::RandomRotation;
using testing::RandomTree;
using testing::RandomVector;

// An ellipsoid on link 6 of a random tree that moves along  q(t) = q + v t + a t²/2 over (not on) the plane.
class RollingKinematicsTest : public ::testing::TestWithParam<int> {
 protected:
  RollingKinematicsTest() : random_(GetParam()), model_(RandomTree(random_, 7)), dynamics_(model_) {
    surface_.joint = 6;
    surface_.surface = Ellipsoid(Vector3(0.7, 0.3, 0.2));
    surface_.p_LE = RandomVector(random_, 3);
    surface_.R_LE = RandomRotation(random_);
    q_ = RandomVector(random_, 7);
    v_ = RandomVector(random_, 7);
    a_ = RandomVector(random_, 7);
    dynamics_.ComputeState(q_, v_, &state_);
    contact_ = ComputeRollingContact(surface_, state_);
  }

  RollingContact At(double t) const {
    BodyDynamics::State state;
    dynamics_.ComputeState(q_ + v_ * t + 0.5 * t * t * a_, v_ + a_ * t, &state);
    return ComputeRollingContact(surface_, state);
  }

  // Central difference of order 2; its error falls as h².
  template <typename F>
  Vector3 Rate(F value, double h) const {
    return (value(At(h)) - value(At(-h))) / (2 * h);
  }

  std::mt19937 random_;
  Model model_;
  BodyDynamics dynamics_;
  ContactSurface surface_;
  VectorX q_, v_, a_;
  BodyDynamics::State state_;
  RollingContact contact_;
};

// Expects that the difference quotient tends to `exact` with its order: at h/10 the error is a hundredth.
template <typename F>
void ExpectRate(const Vector3& exact, F rate) {
  const double coarse = (rate(1e-3) - exact).norm(), fine = (rate(1e-4) - exact).norm();
  EXPECT_GT(exact.norm(), 1e-3);
  EXPECT_LT(fine, 1e-5 * (1 + exact.norm()));
  // Below 1e-9 rounding in the difference quotient takes over.
  EXPECT_LT(fine, coarse / 50 + 1e-9) << "coarse " << coarse << " fine " << fine;
}

TEST_P(RollingKinematicsTest, PointVelocityIsTheRateOfThePoint) {
  ExpectRate(contact_.point_velocity,
             [this](double h) { return Rate([](const RollingContact& c) { return c.p_WP; }, h); });
}

TEST_P(RollingKinematicsTest, DriftCompletesTheRateOfSlip) {
  MatrixX jacobian(3, 7);
  RollingJacobian(dynamics_, surface_, state_, contact_.p_WP, 0, &jacobian);
  EXPECT_TRUE(MatrixNear(jacobian * v_, contact_.slip, 1e-13));
  const Vector3 rate = jacobian * a_ + contact_.drift;
  EXPECT_GT(contact_.drift.norm(), 1e-2);
  ExpectRate(rate, [this](double h) { return Rate([](const RollingContact& c) { return c.slip; }, h); });
}

TEST_P(RollingKinematicsTest, GapIsTheHeightOfThePointAndItsRateTheNormalSlip) {
  EXPECT_NEAR(contact_.gap, contact_.p_WP.z(), 1e-14);
  const double h = 1e-5;
  EXPECT_NEAR((At(h).gap - At(-h).gap) / (2 * h), contact_.slip.z(), 1e-8);
}

TEST_P(RollingKinematicsTest, MotionOverTheSurfaceMeetsTheInverseWeingartenMap) {
  const auto& link = state_[6];
  const Matrix3 R = link.R_WL * surface_.R_LE;
  const Vector3 nu = -R.row(2).transpose();
  const Vector3 omega = link.R_WL * link.twist.angular;
  const Matrix3 S = R * surface_.surface.SupportHessian(nu) * R.transpose();
  EXPECT_TRUE(MatrixNear(contact_.point_velocity - contact_.slip, S * omega.cross(Vector3::UnitZ()), 1e-13));
  EXPECT_TRUE(
      MatrixNear(contact_.p_WP - link.p_WL - link.R_WL * surface_.p_LE, R * surface_.surface.SupportPoint(nu), 1e-14));
}

TEST_P(RollingKinematicsTest, JacobianKeepsToItsDirectionsAndRows) {
  MatrixX all(3, 7), some = MatrixX::Constant(4, 7, 5.0);
  RollingJacobian(dynamics_, surface_, state_, contact_.p_WP, 0, &all);
  surface_.directions = {0, 2};
  RollingJacobian(dynamics_, surface_, state_, contact_.p_WP, 1, &some);
  EXPECT_EQ(some.row(0), MatrixX::Constant(1, 7, 5.0));
  EXPECT_EQ(some.row(1), all.row(0));
  EXPECT_EQ(some.row(2), all.row(2));
  EXPECT_EQ(some.row(3), MatrixX::Constant(1, 7, 5.0));
  for (int j = 0; j < 7; ++j) {
    if (!model_.IsAncestor(j, 6)) {
      EXPECT_EQ(all.col(j).norm(), 0) << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RollingKinematicsTest, ::testing::Range(1, 6));

Vector3 Input(const nlohmann::json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

Vector3 Expected(const nlohmann::json& strings) {
  Vector3 vector;
  for (int i = 0; i < 3; ++i) vector(i) = std::stod(strings[i].get<std::string>());
  return vector;
}

// Axis ratios to 1:1000 against 80-digit values. The plane of each case is turned into z = 0.
TEST(RollingKinematics, ReferenceCases) {
  std::ifstream file(ROLLGAIT_TEST_DATA "/rolling_plane.json");
  const auto data = nlohmann::json::parse(file);
  ASSERT_EQ(data["cases"].size(), 16u);
  const double epsilon = std::numeric_limits<double>::epsilon();
  for (const auto& item : data["cases"]) {
    const auto& expect = item["expect"];
    const Matrix3 Q = Eigen::Quaterniond::FromTwoVectors(Input(item["plane_normal"]).normalized(), Vector3::UnitZ())
                          .toRotationMatrix();
    const auto& quat = item["quat_wxyz"];
    const Vector3 omega = Q * Input(item["omega"]), alpha = Q * Input(item["alpha"]);
    const Vector3 v = Q * Input(item["v_center"]), a = Q * Input(item["a_center"]);
    const Vector3 axes = Input(item["semi_axes"]);
    BodyDynamics::State state(1);
    BodyDynamics::Link& link = state[0];
    link.R_WL = Q * Eigen::Quaterniond(quat[0].get<double>(), quat[1].get<double>(), quat[2].get<double>(),
                                       quat[3].get<double>())
                        .normalized()
                        .toRotationMatrix();
    link.p_WL = Q * (Input(item["center"]) - Input(item["plane_point"]));
    link.twist = {link.R_WL.transpose() * omega, link.R_WL.transpose() * v};
    link.bias = {link.R_WL.transpose() * alpha, link.R_WL.transpose() * (a - omega.cross(v))};
    ContactSurface surface;
    surface.surface = Ellipsoid(axes);
    const RollingContact contact = ComputeRollingContact(surface, state);

    // Turning the case costs a few epsilon of orientation, which an ellipsoid of axis ratio k enlarges: the contact
    // point moves by a_max k a radian, and S changes by its own size over 1/k.
    const double k = axes.maxCoeff() / axes.minCoeff();
    const double r = axes.maxCoeff(), w = omega.norm();
    const double sum = a.norm() + (alpha.norm() + w * w) * r + w * Expected(expect["x_rel_world"]).norm();
    const std::string name = item["family"].get<std::string>();
    SCOPED_TRACE(name);
    const double turn = 20 * epsilon * k;
    EXPECT_TRUE(MatrixNear(contact.p_WP, Q * (Expected(expect["contact_point"]) - Input(item["plane_point"])),
                           turn * r + 20 * epsilon * link.p_WL.norm()));
    EXPECT_NEAR(contact.gap, std::stod(expect["gap"].get<std::string>()), 20 * epsilon * (link.p_WL.norm() + r * k));
    EXPECT_TRUE(MatrixNear(contact.slip, Q * Expected(expect["slip_velocity"]), turn * (v.norm() + w * r)));
    EXPECT_TRUE(MatrixNear(contact.point_velocity, Q * Expected(expect["contact_point_velocity"]),
                           turn * (v.norm() + w * r + Expected(expect["x_rel_world"]).norm())));
    EXPECT_TRUE(MatrixNear(contact.drift, Q * Expected(expect["slip_velocity_dot"]), turn * sum));
  }
}

}  // namespace
}  // namespace rollgait
