#include "core/contact/contact_derivatives.h"

#include <gtest/gtest.h>

#include "tests/support/random_tree.h"

namespace rollgait {
namespace {

using testing::RandomRotation;
using testing::RandomTree;
using testing::RandomVector;

// The definition, without derivatives: lowest point of the surface, velocity of the material point there.
struct Definition {
  const Model& model;
  const ContactSurface& contact;
  Vector3 Point(const VectorX& q) const {
    TreeDynamics tree(model);
    const VectorX zero = VectorX::Zero(model.size());
    tree.UpdateKinematics(q.data(), zero.data());
    const Matrix3 R = tree.rotation(contact.joint) * contact.R_LE;
    const Vector3 nu = -R.row(2).transpose();
    return tree.origin(contact.joint) + tree.rotation(contact.joint) * contact.p_LE +
           R * contact.surface.SupportPoint(nu);
  }
  // yᵀ J(q) u
  double Beta(const VectorX& q, const Vector3& y, const VectorX& u) const {
    TreeDynamics tree(model);
    tree.UpdateKinematics(q.data(), u.data());
    const Vector6& twist = tree.twist(contact.joint);
    return y.dot(twist.tail<3>() + twist.head<3>().cross(Point(q)));
  }
};

class ContactDerivativesTest : public ::testing::Test {
 protected:
  ContactDerivativesTest() : model_(RandomTree(random_, kJoints)) {
    // The deepest joint.
    std::vector<int> depth(kJoints, 1);
    for (int i = 0; i < kJoints; ++i) {
      if (model_.parent(i) >= 0) depth[i] = depth[model_.parent(i)] + 1;
      if (depth[i] > depth[contact_.joint]) contact_.joint = i;
    }
    contact_.surface = Ellipsoid(Vector3(0.13, 0.05, 0.07));
    contact_.p_LE = Vector3(0.1, -0.2, 0.3);
    contact_.R_LE = RandomRotation(random_);
    q_ = RandomVector(random_, kJoints, 2);
    v_ = RandomVector(random_, kJoints, 2);
    a_ = RandomVector(random_, kJoints, 5);
    u_ = RandomVector(random_, kJoints, 2);
    y_ = RandomVector(random_, 3);
  }
  static constexpr int kJoints = 20;
  static constexpr double kStep = 1e-4;       // second differences: truncation 1e-8, rounding 1e-8
  static constexpr double kTolerance = 2e-5;  // times third and fourth derivatives of order 100
  std::mt19937 random_{11};
  Model model_;
  ContactSurface contact_;
  VectorX q_, v_, a_, u_;
  Vector3 y_;
};

TEST_F(ContactDerivativesTest, BilinearFormMeetsDifferencesOfItsDefinition) {
  TreeDynamics tree(model_);
  tree.UpdateKinematics(q_.data(), v_.data());
  ContactDerivatives<double> contact(model_, contact_);
  contact.Update(tree);
  contact.UpdateSecond();
  const Definition definition{model_, contact_};
  auto field = contact.MakeField();
  VectorX u_path(contact.path_size());
  for (int k = 0; k < contact.path_size(); ++k) u_path(k) = u_(contact.path()[k]);
  contact.ComputeField(u_path.data(), &field);
  EXPECT_LT((contact.point() - definition.Point(q_)).norm(), 1e-13);
  EXPECT_NEAR(y_.dot(contact.Velocity(field)), definition.Beta(q_, y_, u_), 1e-12);
  ASSERT_GT(contact.path_size(), 2);
  const auto moved = [&](int k, double step) {
    VectorX q = q_;
    q(contact.path()[k]) += step;
    return q;
  };
  for (int k = 0; k < contact.path_size(); ++k) {
    const VectorX up = moved(k, kStep), down = moved(k, -kStep);
    EXPECT_LT(((definition.Point(up) - definition.Point(down)) / (2 * kStep) - contact.PointDerivative(k)).norm(),
              1e-6);
    const double dbeta = (definition.Beta(up, y_, u_) - definition.Beta(down, y_, u_)) / (2 * kStep);
    EXPECT_NEAR(dbeta, y_.dot(field.gradient[k]), kTolerance);
    for (int m = 0; m < contact.path_size(); ++m) {
      VectorX upup = up, updown = up, downup = down, downdown = down;
      const int j = contact.path()[m];
      upup(j) += kStep;
      updown(j) -= kStep;
      downup(j) += kStep;
      downdown(j) -= kStep;
      const auto second = [&](auto f) { return (f(upup) - f(updown) - f(downup) + f(downdown)) / (4 * kStep * kStep); };
      EXPECT_NEAR(second([&](const VectorX& q) { return definition.Beta(q, y_, u_); }),
                  contact.ContractedSecond(field, y_, m, k), 20 * kTolerance)
          << m << " " << k;
      EXPECT_NEAR(second([&](const VectorX& q) { return y_.dot(definition.Point(q)); }),
                  y_.dot(contact.PointSecond(m, k)), 20 * kTolerance)
          << m << " " << k;
      const VectorX unit = VectorX::Unit(kJoints, contact.path()[m]);
      const double djac = (definition.Beta(up, y_, unit) - definition.Beta(down, y_, unit)) / (2 * kStep);
      EXPECT_NEAR(djac, y_.dot(contact.JacobianDerivative(k, m)), kTolerance) << m << " " << k;
    }
  }
}

TEST_F(ContactDerivativesTest, SurfacePointMeetsDifferences) {
  TreeDynamics tree(model_);
  const VectorX zero = VectorX::Zero(kJoints);
  ContactDerivatives<double> contact(model_, contact_);
  const auto at = [&](const VectorX& q) {
    tree.UpdateKinematics(q.data(), zero.data());
    contact.Update(tree);
    contact.UpdateSecond();
  };
  at(q_);
  const int size = contact.path_size();
  std::vector<Vector3> first(size), second(size * size);
  for (int k = 0; k < size; ++k) {
    first[k] = contact.SurfacePointDerivative(k);
    for (int m = 0; m < size; ++m) second[k * size + m] = contact.SurfacePointSecond(m, k);
  }
  const double step = 1e-6;
  for (int m = 0; m < size; ++m) {
    VectorX q = q_;
    q(contact.path()[m]) += step;
    at(q);
    const Vector3 up = contact.surface_point();
    std::vector<Vector3> up_first(size);
    for (int k = 0; k < size; ++k) up_first[k] = contact.SurfacePointDerivative(k);
    q(contact.path()[m]) -= 2 * step;
    at(q);
    EXPECT_LT(((up - contact.surface_point()) / (2 * step) - first[m]).norm(), 1e-8);
    for (int k = 0; k < size; ++k) {
      EXPECT_LT(((up_first[k] - contact.SurfacePointDerivative(k)) / (2 * step) - second[k * size + m]).norm(), 1e-7);
    }
  }
}

// The dual part along (v, a) is the time derivative along any motion with these rates.
TEST_F(ContactDerivativesTest, DualPartIsTheDerivativeAlongTheMotion) {
  TreeDynamics tree(model_);
  ContactDerivatives<Dual> dual(model_, contact_);
  ContactDerivatives<double> plain(model_, contact_);
  const int size = dual.path_size();
  tree.UpdateKinematics(q_.data(), v_.data());
  dual.Update(tree);
  dual.UpdateSecond();
  std::vector<Dual> u(size);
  for (int k = 0; k < size; ++k) u[k] = Dual(v_(dual.path()[k]), a_(dual.path()[k]));
  auto field = dual.MakeField();
  dual.ComputeField(u.data(), &field);
  const Eigen::Matrix<Dual, 3, 1> y = y_.cast<Dual>();

  const double step = 1e-6;
  auto plain_field = plain.MakeField();
  MatrixX seconds[2];
  Vector3 velocities[2];
  for (int side = 0; side < 2; ++side) {
    const double t = side == 0 ? -step : step;
    const VectorX q = q_ + t * v_, v = v_ + t * a_;
    tree.UpdateKinematics(q.data(), v.data());
    plain.Update(tree);
    plain.UpdateSecond();
    VectorX path_u(size);
    for (int k = 0; k < size; ++k) path_u(k) = v(plain.path()[k]);
    plain.ComputeField(path_u.data(), &plain_field);
    velocities[side] = plain.Velocity(plain_field);
    seconds[side].resize(size, size);
    for (int k = 0; k < size; ++k) {
      for (int m = 0; m < size; ++m) seconds[side](m, k) = plain.ContractedSecond(plain_field, y_, m, k);
    }
  }
  const Vector3 rate = (velocities[1] - velocities[0]) / (2 * step);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(dual.Velocity(field)(i).d, rate(i), 1e-6 * (1 + rate.norm()));
  const MatrixX second_rate = (seconds[1] - seconds[0]) / (2 * step);
  EXPECT_GT(second_rate.norm(), 1);
  for (int k = 0; k < size; ++k) {
    for (int m = 0; m < size; ++m) {
      EXPECT_NEAR(dual.ContractedSecond(field, y, m, k).d, second_rate(m, k), 1e-6 * (1 + second_rate.norm()));
    }
  }
}

}  // namespace
}  // namespace rollgait
