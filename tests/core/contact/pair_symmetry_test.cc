// Laws of two surfaces that hold for every pair and motion, 100 000 cases: time reversal, units of length and time, the
// axes they are written in, mirrors, exchange of the bodies, and the rates of the gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contact/surface_pair.h"
#include "tests/support/extreme_contacts.h"
#include "tests/support/mapped_motion.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

constexpr int kCases = 20000;

struct Case {
  PlacedSurface one, two;
  FrameMotion body_1, body_2;
  double length;  // m, of both and the way between them
  double rate;    // 1/s, of everything that turns or moves
};

// Two ellipsoids apart, at any size and spin; the axis ratio is up to 1e3, or a moderate one.
Case Draw(ExtremeContacts* extremes, bool moderate) {
  SeededRandom& random = extremes->random();
  Case drawn;
  const double size = random.LogUniform(1e-3, 1e3);
  const auto axes = [&]() -> Vector3 {
    if (moderate) return size * random.Vector(0.3, 1);
    return size * Vector3(random.LogUniform(1e-3, 1), 1, random.LogUniform(1e-3, 1));
  };
  for (PlacedSurface* placed : {&drawn.one, &drawn.two}) {
    placed->surface = Ellipsoid(axes());
    placed->p_BE = size * random.Vector(-0.5, 0.5);
    placed->R_BE = extremes->Rotation();
  }
  drawn.body_1 = extremes->Motion(size);
  drawn.body_2 = extremes->Motion(size);
  drawn.body_2.p_WB = drawn.body_1.p_WB + size * random.Uniform(4.1, 6) * random.Unit();
  drawn.length = size * 10;
  drawn.rate = std::max(drawn.body_1.w_WB.norm(), drawn.body_2.w_WB.norm());
  return drawn;
}

PairKinematics Compute(const Case& at) { return SurfacePair(at.one, at.two).Compute(at.body_1, at.body_2); }

// Rounding of the normal by ε / 0.3 at most for moderate bodies apart, and of what follows from it by some of these.
void ExpectMappedNear(const PairKinematics& one, const PairKinematics& other, const Matrix3& Q, const Case& at) {
  const double length = 256 * kEpsilon * at.length, rate = at.rate;
  EXPECT_TRUE(MatrixNear(other.p_1, Q * one.p_1, length));
  EXPECT_TRUE(MatrixNear(other.p_2, Q * one.p_2, length));
  EXPECT_TRUE(MatrixNear(other.normal, Q * one.normal, 256 * kEpsilon));
  EXPECT_NEAR(other.gap, one.gap, length);
  EXPECT_TRUE(MatrixNear(other.slip, Q * one.slip, 4 * length * rate));
  EXPECT_NEAR(other.gap_rate, one.gap_rate, 4 * length * rate);
  EXPECT_TRUE(MatrixNear(other.normal_dot, Q * one.normal_dot, 2048 * kEpsilon * rate));
  EXPECT_TRUE(MatrixNear(other.p_dot_1, Q * one.p_dot_1, 8 * length * rate));
  EXPECT_TRUE(MatrixNear(other.p_dot_2, Q * one.p_dot_2, 8 * length * rate));
  EXPECT_TRUE(MatrixNear(other.drift, Q * one.drift, 16 * length * rate * rate));
  EXPECT_NEAR(other.gap_acceleration, one.gap_acceleration, 16 * length * rate * rate);
}

// ω → −ω, v → −v: velocities turn round, γ stays; to the last bit.
TEST(PairSymmetryTest, TimeReversal) {
  ExtremeContacts extremes(301);
  for (int i = 0; i < kCases; ++i) {
    Case at = Draw(&extremes, false);
    const PairKinematics forward = Compute(at);
    for (FrameMotion* body : {&at.body_1, &at.body_2}) body->v_WB = -body->v_WB, body->w_WB = -body->w_WB;
    const PairKinematics backward = Compute(at);
    ASSERT_TRUE(forward.regular);
    EXPECT_EQ(backward.p_1, forward.p_1);
    EXPECT_EQ(backward.normal_dot, -forward.normal_dot);
    EXPECT_EQ(backward.slip, -forward.slip);
    EXPECT_EQ(backward.p_dot_1, -forward.p_dot_1);
    EXPECT_EQ(backward.p_dot_2, -forward.p_dot_2);
    EXPECT_EQ(backward.drift, forward.drift);
    EXPECT_EQ(backward.gap_acceleration, forward.gap_acceleration);
  }
}

// Bodies 2⁵ times as large, moving 2³ times as fast: to the last bit.
TEST(PairSymmetryTest, ScalingLaws) {
  ExtremeContacts extremes(302);
  const double length = 32, rate = 8;
  for (int i = 0; i < kCases; ++i) {
    const Case at = Draw(&extremes, false);
    Case large = at;
    for (PlacedSurface* placed : {&large.one, &large.two}) {
      placed->surface = Ellipsoid(length * placed->surface.ellipsoid()->semi_axes());
      placed->p_BE *= length;
    }
    large.body_1 = Mapped(at.body_1, Matrix3::Identity(), 1, length, rate);
    large.body_2 = Mapped(at.body_2, Matrix3::Identity(), 1, length, rate);
    ExpectMapped(Compute(at), Compute(large), Matrix3::Identity(), length, rate);
  }
}

TEST(PairSymmetryTest, FrameInvariance) {
  ExtremeContacts extremes(303);
  for (int i = 0; i < kCases; ++i) {
    const Case at = Draw(&extremes, true);
    const Matrix3 Q = ExtremeContacts::Turn(3 * extremes.random().Unit());
    Case turned = at;
    turned.body_1 = Mapped(at.body_1, Q, 1, 1, 1);
    turned.body_2 = Mapped(at.body_2, Q, 1, 1, 1);
    ExpectMappedNear(Compute(at), Compute(turned), Q, at);
  }
}

TEST(PairSymmetryTest, MirrorSymmetry) {
  ExtremeContacts extremes(304);
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  for (int i = 0; i < kCases; ++i) {
    const Case at = Draw(&extremes, true);
    Case image = at;
    image.body_1 = Mapped(at.body_1, mirror, -1, 1, 1);
    image.body_2 = Mapped(at.body_2, mirror, -1, 1, 1);
    for (PlacedSurface* placed : {&image.one, &image.two}) {
      placed->p_BE = mirror * placed->p_BE;
      placed->R_BE = mirror * placed->R_BE * mirror;
    }
    ExpectMappedNear(Compute(at), Compute(image), mirror, at);
  }
}

// Exchanged, the normal and all relative motion turn round; the gap and its rates are the same, and they are what slip
// and drift say:  φ̇ = n · w,  φ̈ = n · ẇ + ṅ · w,  p₁ − p₂ = φ n,  ṗ₁ − ṗ₂ = φ̇ n + φ ṅ.
TEST(PairSymmetryTest, ExchangeOfTheBodiesAndTheGap) {
  ExtremeContacts extremes(305);
  for (int i = 0; i < kCases; ++i) {
    const Case at = Draw(&extremes, true);
    PairKinematics pair = Compute(at);
    const PairKinematics other = Compute({at.two, at.one, at.body_2, at.body_1, at.length, at.rate});
    const double length = 256 * kEpsilon * at.length, rate = at.rate;
    const Vector3 &n = pair.normal, &w = pair.slip;
    EXPECT_NEAR(pair.gap_rate, n.dot(w), length * rate);
    EXPECT_NEAR(pair.gap_acceleration, n.dot(pair.drift) + pair.normal_dot.dot(w), length * rate * rate);
    EXPECT_TRUE(MatrixNear(pair.p_1 - pair.p_2, pair.gap * n, length));
    EXPECT_TRUE(
        MatrixNear(pair.p_dot_1 - pair.p_dot_2, pair.gap_rate * n + pair.gap * pair.normal_dot, 4 * length * rate));
    std::swap(pair.p_1, pair.p_2);
    std::swap(pair.p_dot_1, pair.p_dot_2);
    for (Vector3* u : {&pair.normal, &pair.normal_dot, &pair.slip, &pair.drift}) *u = -*u;
    ExpectMappedNear(pair, other, Matrix3::Identity(), at);
  }
}

}  // namespace
}  // namespace rollgait
