// A surface over a plane: laws that hold for every body and motion, at the extremes of size, shape and spin.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/contact/pair_kinematics.h"
#include "tests/support/extreme_contacts.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/mapped_motion.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

struct Case {
  PlacedSurface surface;
  FrameMotion body, ground;
  PlacedPlane plane;
  double length;  // m, of the body
};

Case Draw(ExtremeContacts* extremes) {
  Case drawn;
  drawn.surface.surface = extremes->AnySurface();
  drawn.length = drawn.surface.surface.Size();
  if (extremes->Choice(2) == 0) {
    drawn.surface.p_BE = drawn.length * extremes->random().Vector(-1, 1);
    drawn.surface.R_BE = extremes->Rotation();
  }
  drawn.body = extremes->Motion(drawn.length);
  drawn.ground.p_WB = drawn.length * extremes->random().Vector(-1, 1);
  if (extremes->Choice(2) == 0) drawn.ground = extremes->Motion(drawn.length);
  drawn.plane.p_BO = drawn.length * extremes->random().Vector(-1, 1);
  if (extremes->Choice(3) == 0) drawn.plane.n_B = extremes->random().Unit();
  return drawn;
}

PairKinematics Compute(const Case& at) { return ComputePlaneContact(at.surface, at.body, at.plane, at.ground); }

bool NoNaN(const PairKinematics& at) {
  return !at.p_1.hasNaN() && !at.p_2.hasNaN() && !at.normal.hasNaN() && !std::isnan(at.gap) && !at.slip.hasNaN() &&
         !at.p_dot_1.hasNaN() && !at.p_dot_2.hasNaN() && !at.normal_dot.hasNaN() && !at.drift.hasNaN() &&
         !std::isnan(at.gap_acceleration) && !std::isnan(at.gap_rate);
}

TEST(PairPlaneTest, NothingIsEverNotANumberAndFlatsAreReported) {
  ExtremeContacts extremes(101);
  int flat = 0;
  for (int i = 0; i < 60000; ++i) {
    const Case at = Draw(&extremes);
    const PairKinematics pair = Compute(at);
    ASSERT_TRUE(NoNaN(pair)) << i;
    ASSERT_TRUE(pair.p_1.allFinite() && pair.slip.allFinite() && std::isfinite(pair.gap)) << i;
    ASSERT_EQ(pair.regular, pair.drift.allFinite()) << i;
    if (!pair.regular) {
      ++flat;
      EXPECT_EQ(pair.drift, Vector3::Constant(kInfinity));
      EXPECT_EQ(pair.gap_acceleration, kInfinity);
    }
  }
  EXPECT_GT(flat, 100);  // boxes that stand exactly on a face
  EXPECT_LT(flat, 6000);
}

// ω → −ω, v → −v: velocities turn round, γ stays; to the last bit.
TEST(PairPlaneTest, TimeReversal) {
  ExtremeContacts extremes(102);
  for (int i = 0; i < 20000; ++i) {
    Case at = Draw(&extremes);
    const PairKinematics forward = Compute(at);
    for (FrameMotion* body : {&at.body, &at.ground}) body->v_WB = -body->v_WB, body->w_WB = -body->w_WB;
    const PairKinematics backward = Compute(at);
    ASSERT_EQ(forward.regular, backward.regular);
    EXPECT_EQ(backward.p_1, forward.p_1);
    EXPECT_EQ(backward.slip, -forward.slip);
    EXPECT_EQ(backward.gap_rate, -forward.gap_rate);
    if (!forward.regular) continue;
    EXPECT_EQ(backward.p_dot_1, -forward.p_dot_1);
    EXPECT_EQ(backward.drift, forward.drift);
    EXPECT_EQ(backward.gap_acceleration, forward.gap_acceleration);
  }
}

// In a mirror, bodies that are symmetric about their coordinate planes move like their images; to the last bit.
TEST(PairPlaneTest, MirrorSymmetry) {
  ExtremeContacts extremes(103);
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  for (int i = 0; i < 20000; ++i) {
    const Case at = Draw(&extremes);
    Case image = at;
    image.body = Mapped(at.body, mirror, -1, 1, 1);
    image.ground = Mapped(at.ground, mirror, -1, 1, 1);
    image.surface.p_BE = mirror * at.surface.p_BE;
    image.surface.R_BE = mirror * at.surface.R_BE * mirror;
    image.plane.p_BO = mirror * at.plane.p_BO;
    image.plane.n_B = mirror * at.plane.n_B;
    ExpectMapped(Compute(at), Compute(image), mirror, 1, 1);
  }
}

// A body 2⁵ times as large, moving 2³ times as fast: everything follows by its unit; to the last bit.
TEST(PairPlaneTest, ScalingLaws) {
  ExtremeContacts extremes(104);
  const double length = 32, rate = 8;
  for (int i = 0; i < 20000; ++i) {
    Case at = Draw(&extremes);
    at.surface.surface = Ellipsoid(extremes.Axes());
    Case large = at;
    large.surface.surface = Ellipsoid(length * at.surface.surface.ellipsoid()->semi_axes());
    large.body = Mapped(at.body, Matrix3::Identity(), 1, length, rate);
    large.ground = Mapped(at.ground, Matrix3::Identity(), 1, length, rate);
    large.surface.p_BE *= length;
    large.plane.p_BO *= length;
    ExpectMapped(Compute(at), Compute(large), Matrix3::Identity(), length, rate);
  }
}

// The laws do not depend on the axes they are written in. Turning the world rounds ν, and a body of axis ratio k
// answers to that with k ε; S turns by O(1) over an angle 1/k.
TEST(PairPlaneTest, FrameInvariance) {
  ExtremeContacts extremes(105);
  for (int i = 0; i < 20000; ++i) {
    Case at = Draw(&extremes);
    const Vector3 axes = extremes.Axes();
    at.surface.surface = Ellipsoid(axes);
    const Matrix3 Q = ExtremeContacts::Turn(3 * extremes.random().Unit());
    Case turned = at;
    turned.body = Mapped(at.body, Q, 1, 1, 1);
    turned.ground = Mapped(at.ground, Q, 1, 1, 1);
    const PairKinematics one = Compute(at), other = Compute(turned);
    const double k = axes.maxCoeff() / axes.minCoeff();
    const Vector3 nu = -(at.body.R_WB * at.surface.R_BE).transpose() * one.normal;
    const double S = at.surface.surface.SupportHessian(nu).norm();
    // Lengths and rates of everything that takes part.
    const double length = at.body.p_WB.norm() + at.ground.p_WB.norm() + at.surface.p_BE.norm() + at.plane.p_BO.norm() +
                          axes.maxCoeff() + at.length;
    const double spin = at.body.w_WB.norm() + at.ground.w_WB.norm();
    const double moved = 32 * kEpsilon * (length + S);  // of the contact point
    const double speed = at.body.v_WB.norm() + at.ground.v_WB.norm() + spin * length;
    const double bend = 128 * kEpsilon * k * spin * S + 32 * kEpsilon * speed + spin * moved;
    const double acceleration = at.body.a_WB.norm() + at.ground.a_WB.norm() +
                                (at.body.alpha_WB.norm() + at.ground.alpha_WB.norm()) * length + spin * speed;
    const double alpha = at.body.alpha_WB.norm() + at.ground.alpha_WB.norm() + spin * spin;
    EXPECT_TRUE(MatrixNear(other.p_1, Q * one.p_1, moved));
    EXPECT_NEAR(other.gap, one.gap, 32 * kEpsilon * length);
    EXPECT_TRUE(MatrixNear(other.slip, Q * one.slip, 32 * kEpsilon * speed + spin * moved));
    EXPECT_TRUE(MatrixNear(other.p_dot_1, Q * one.p_dot_1, bend));
    EXPECT_TRUE(MatrixNear(other.drift, Q * one.drift, 2 * spin * bend + 32 * kEpsilon * acceleration + alpha * moved));
  }
}

// φ̇ = n · w, and φ̈ on a fixed plane in the form n · (a + α×r + ω×(ω×r)) − (ω×n)ᵀ S (ω×n), whose last term never
// lifts.
TEST(PairPlaneTest, GapIdentities) {
  ExtremeContacts extremes(106);
  for (int i = 0; i < 20000; ++i) {
    Case at = Draw(&extremes);
    at.ground = FrameMotion();
    const PairKinematics pair = Compute(at);
    if (!pair.regular) continue;
    const Vector3& n = pair.normal;
    const Matrix3 R = at.body.R_WB * at.surface.R_BE;
    const Matrix3 S = R * at.surface.surface.SupportHessian(-R.transpose() * n) * R.transpose();
    const Vector3 r = pair.p_1 - at.body.p_WB, across = at.body.w_WB.cross(n);
    const Vector3& w = at.body.w_WB;
    const Vector3 material = at.body.a_WB + at.body.alpha_WB.cross(r) + w.cross(w.cross(r));
    const double rolling = across.dot(S * across);
    EXPECT_NEAR(pair.gap_rate, n.dot(at.body.v_WB + w.cross(r)),
                16 * kEpsilon * (at.body.v_WB.norm() + w.norm() * r.norm()));
    const double size = material.norm() + w.squaredNorm() * (r.norm() + S.norm() + at.body.p_WB.norm());
    EXPECT_NEAR(pair.gap_acceleration, n.dot(material) - rolling, 64 * kEpsilon * size);
    EXPECT_GE(rolling, -64 * kEpsilon * S.norm() * across.squaredNorm());
    EXPECT_TRUE(MatrixNear(pair.p_1 - pair.p_2, pair.gap * n, 8 * kEpsilon * (pair.p_1.norm() + std::abs(pair.gap))));
  }
}

// A sphere's contact point stays under its centre: ṙ = 0 on a fixed plane, and no force of γ but the frame's.
TEST(PairPlaneTest, SphereHasNoGeometricDrift) {
  ExtremeContacts extremes(107);
  for (int i = 0; i < 2000; ++i) {
    const double radius = extremes.random().LogUniform(1e-3, 1e3);
    PlacedSurface surface;
    surface.surface = Sphere(radius);
    FrameMotion body = extremes.Motion(radius);
    body.alpha_WB = body.a_WB = Vector3::Zero();
    const PairKinematics pair = ComputePlaneContact(surface, body, {}, {});
    const double rate = body.w_WB.norm();
    EXPECT_TRUE(MatrixNear(pair.p_dot_1, body.v_WB, 8 * kEpsilon * rate * radius));
    EXPECT_TRUE(MatrixNear(pair.drift, Vector3::Zero(), 8 * kEpsilon * rate * rate * radius));
  }
}

// Along a real motion of body and plane, against differences of the definition.
TEST(PairPlaneTest, VelocitiesAndAccelerationsAreDerivativesAlongAMotion) {
  SeededRandom random(108);
  const Ellipsoid ellipsoid({0.8, 1.2, 0.5});
  for (const Surface& surface : {Surface(ellipsoid), Surface(ellipsoid).Rounded(0.3)}) {
    const PlacedSurface placed{surface, {0.1, -0.2, 0.3}, ExtremeContacts::Turn({0.1, 0.7, -0.3})};
    const PlacedPlane plane{{0.2, 0.1, 0.4}, random.Unit()};
    // R(t) = exp(w t + α t²/2) R: at t = 0 the spin is w and its rate α.
    FrameMotion start[2];
    for (FrameMotion& body : start) {
      body = {ExtremeContacts::Turn(2 * random.Unit()),
              random.Vector(-1, 1),
              random.Vector(-1, 1),
              random.Vector(-1, 1),
              random.Vector(-1, 1),
              random.Vector(-1, 1)};
    }
    const auto at = [&](double t) {
      FrameMotion moved[2];
      for (int i = 0; i < 2; ++i) {
        moved[i].R_WB = ExtremeContacts::Turn(start[i].w_WB * t + start[i].alpha_WB * (t * t / 2)) * start[i].R_WB;
        moved[i].p_WB = start[i].p_WB + start[i].v_WB * t + start[i].a_WB * (t * t / 2);
      }
      return ComputePlaneContact(placed, moved[0], plane, moved[1]);
    };
    const PairKinematics now = ComputePlaneContact(placed, start[0], plane, start[1]);
    const auto p_1 = [&](double t) { return at(t).p_1; };
    const auto p_2 = [&](double t) { return at(t).p_2; };
    const auto gap = [&](double t) { return Eigen::Matrix<double, 1, 1>(at(t).gap); };
    EXPECT_TRUE(MatrixNear(HighOrderDifference(p_1, 0.01), now.p_dot_1, 1e-11));
    EXPECT_TRUE(MatrixNear(HighOrderDifference(p_2, 0.01), now.p_dot_2, 1e-11));
    EXPECT_NEAR(HighOrderDifference(gap, 0.01)(0), now.gap_rate, 1e-11);
    EXPECT_NEAR(HighOrderSecondDifference(gap, 0.01)(0), now.gap_acceleration, 1e-9);
    EXPECT_GT(now.drift.norm(), 0.1);
  }
}

}  // namespace
}  // namespace rollgait
