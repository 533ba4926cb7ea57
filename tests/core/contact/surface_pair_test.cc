// Two surfaces: convergence wherever they are, and laws that hold for every pair.
#include "core/contact/surface_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/separating_plane.h"
#include "tests/support/extreme_contacts.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

using State = Separation::State;

double G(const PosedSurface& one, const PosedSurface& two, const Vector3& nu) {
  return nu.dot(two.p_WE - one.p_WE) - one.surface->Support(one.R_WE.transpose() * nu) -
         two.surface->Support(-(two.R_WE.transpose() * nu));
}

// max g by a second algorithm: random search with a shrinking radius from every corner of the sphere.
double SampledDistance(const PosedSurface& one, const PosedSurface& two, SeededRandom* random) {
  double best = -kInfinity;
  for (int start = 0; start < 14; ++start) {
    Vector3 nu = start == 0 ? Vector3((two.p_WE - one.p_WE).normalized()) : random->Unit();
    double value = G(one, two, nu);
    for (double radius = 1; radius > 1e-7; radius *= 0.95) {
      for (int i = 0; i < 4; ++i) {
        const Vector3 other = (nu + radius * random->Unit()).normalized();
        const double other_value = G(one, two, other);
        if (other_value > value) nu = other, value = other_value;
      }
    }
    best = std::max(best, value);
  }
  return best;
}

struct Two {
  Surface surface_1 = Sphere(1), surface_2 = Sphere(1);
  Matrix3 R_1, R_2;
  Vector3 p_1, p_2;
  PosedSurface one() const { return {&surface_1, R_1, p_1}; }
  PosedSurface two() const { return {&surface_2, R_2, p_2}; }
  double size() const { return surface_1.Size() + surface_2.Size() + (p_2 - p_1).norm(); }
};

Two DrawEllipsoids(ExtremeContacts* extremes) {
  Two drawn;
  drawn.surface_1 = Ellipsoid(extremes->Axes());
  drawn.surface_2 = Ellipsoid(extremes->Axes());
  drawn.R_1 = extremes->Rotation();
  drawn.R_2 = extremes->Rotation();
  const double size = drawn.surface_1.Size() + drawn.surface_2.Size();
  drawn.p_1 = size * extremes->random().Vector(-1, 1);
  drawn.p_2 = drawn.p_1 + size * extremes->Scaled(extremes->random().Unit(), 0.01, 10);
  return drawn;
}

TEST(SurfacePairTest, SeparatedBodiesAlwaysConvergeToTheDistance) {
  ExtremeContacts extremes(201);
  int separated = 0, overlapping = 0, most = 0;
  for (int i = 0; i < 6000; ++i) {
    const Two bodies = DrawEllipsoids(&extremes);
    const Separation at = FindSeparation(bodies.one(), bodies.two(), nullptr);
    ASSERT_TRUE(at.converged) << i;
    ASSERT_NE(at.state, State::kTouching) << i;
    most = std::max(most, at.iterations);
    // The contact points are what they claim to be: p₂ − p₁ = d ν. Rounding of ν moves points by S.
    const Vector3 gap = bodies.p_2 + at.r_2 - bodies.p_1 - at.r_1;
    const double S = bodies.surface_1.SupportHessian(bodies.R_1.transpose() * at.nu).norm() +
                     bodies.surface_2.SupportHessian(-bodies.R_2.transpose() * at.nu).norm();
    EXPECT_TRUE(MatrixNear(gap, at.distance * at.nu, 64 * kEpsilon * (bodies.size() + S))) << i;
    (at.state == State::kSeparated ? separated : overlapping) += 1;
    if (at.state == State::kSeparated) {
      EXPECT_GT(at.distance, 0);
      // g is concave: no other plane separates further. A few of all others:
      for (int n = 0; n < 5; ++n) {
        EXPECT_LE(G(bodies.one(), bodies.two(), extremes.random().Unit()), at.distance + 1e-14 * bodies.size());
      }
      // From a wrong start, the opposite side included.
      const Vector3 start = i % 4 == 0 ? Vector3(-at.nu) : extremes.random().Unit();
      const Separation again = FindSeparation(bodies.one(), bodies.two(), &start);
      EXPECT_TRUE(again.converged);
      EXPECT_NEAR(again.distance, at.distance, 64 * kEpsilon * bodies.size()) << i;
    }
  }
  EXPECT_GT(separated, 1000);
  EXPECT_GT(overlapping, 1000);
  EXPECT_LE(most, 300);
}

TEST(SurfacePairTest, AgreesWithRandomSearch) {
  ExtremeContacts extremes(202);
  for (int i = 0; i < 60; ++i) {
    Two bodies = DrawEllipsoids(&extremes);
    const double exponents[] = {0.3, 0.7, 1.0, 1.4, 1.8};
    if (i % 2 == 0) {
      bodies.surface_1 = Superellipsoid(Vector3(0.8, 1.1, 0.5), exponents[i % 5], exponents[(i / 5) % 5]);
      bodies.surface_2 = Superellipsoid(Vector3(0.4, 0.9, 0.7), exponents[(i / 2) % 5], exponents[(i / 3) % 5]);
      bodies.p_1.setZero();
      bodies.p_2 = 2.5 * extremes.random().Unit();
    }
    const Separation at = FindSeparation(bodies.one(), bodies.two(), nullptr);
    const double sampled = SampledDistance(bodies.one(), bodies.two(), &extremes.random());
    EXPECT_LE(sampled, at.distance + 1e-12 * bodies.size()) << i;
    EXPECT_NEAR(at.distance, sampled, 1e-5 * bodies.size()) << i;
  }
}

TEST(SurfacePairTest, BoxesConvergeFaceToFaceAndCornerToFace) {
  ExtremeContacts extremes(203);
  int most = 0;
  for (int i = 0; i < 10000; ++i) {
    Two bodies;
    const double e[] = {0.05, 0.1, 0.3, 0.6, 1.0, 1.5, 1.95};
    bodies.surface_1 = Superellipsoid(extremes.random().Vector(0.2, 1), e[i % 7], e[i / 7 % 7]);
    bodies.surface_2 = Superellipsoid(extremes.random().Vector(0.2, 1), e[i / 3 % 7], e[i / 5 % 7]);
    if (i % 5 == 4) {
      bodies.surface_1 = bodies.surface_1.Rounded(extremes.random().LogUniform(1e-3, 1));
      bodies.surface_2 = bodies.surface_2.Rounded(extremes.random().LogUniform(1e-3, 1));
    }
    bodies.R_1 = extremes.Rotation();
    bodies.R_2 = i % 3 == 0 ? bodies.R_1 : extremes.Rotation();
    bodies.p_1.setZero();
    bodies.p_2 = i % 3 == 1 ? Vector3(4 * bodies.R_1.col(i % 3)) : Vector3(4 * extremes.random().Unit());
    const Separation at = FindSeparation(bodies.one(), bodies.two(), nullptr);
    EXPECT_TRUE(at.converged) << i << " after " << at.iterations;
    most = std::max(most, at.iterations);
    EXPECT_EQ(at.state, State::kSeparated);
    for (int n = 0; n < 50; ++n) {
      const Vector3 other = (at.nu + extremes.Scaled(extremes.random().Unit(), 1e-6, 1)).normalized();
      EXPECT_LE(G(bodies.one(), bodies.two(), other) - at.distance, 1e-13) << i << " " << at.iterations;
    }
  }
  EXPECT_LE(most, 200) << "half of what it may take; 103 in 400 000 other pairs";
}

// 1e-12 of their size apart, touching within rounding, and as much inside each other: the distance passes through zero.
TEST(SurfacePairTest, NearTouch) {
  ExtremeContacts extremes(204);
  for (int i = 0; i < 1000; ++i) {
    Two bodies = DrawEllipsoids(&extremes);
    bodies.p_1.setZero();
    bodies.p_2 = 3 * (bodies.surface_1.Size() + bodies.surface_2.Size()) * extremes.random().Unit();
    const Separation apart = FindSeparation(bodies.one(), bodies.two(), nullptr);
    ASSERT_EQ(apart.state, State::kSeparated);
    const double size = bodies.surface_1.Size() + bodies.surface_2.Size();
    for (const double gap : {1e-12, -1e-12, 1e-8, -1e-8}) {
      Two close = bodies;
      close.p_2 -= (apart.distance - gap * size) * apart.nu;
      const Separation at = FindSeparation(close.one(), close.two(), i % 2 == 0 ? &apart.nu : nullptr);
      EXPECT_TRUE(at.converged);
      EXPECT_NEAR(at.distance, gap * size, 64 * kEpsilon * bodies.size()) << i;
      EXPECT_EQ(at.state == State::kSeparated, gap > 0) << i;
    }
  }
}

TEST(SurfacePairTest, SpheresAreClosedForm) {
  ExtremeContacts extremes(205);
  for (int i = 0; i < 2000; ++i) {
    const double r_1 = extremes.random().LogUniform(1e-3, 1e3), r_2 = extremes.random().LogUniform(1e-3, 1e3);
    SurfacePair pair({Sphere(r_1), Vector3::Zero(), Matrix3::Identity()},
                     {Sphere(r_2), Vector3::Zero(), Matrix3::Identity()});
    const FrameMotion body_1 = extremes.Motion(r_1), body_2 = extremes.Motion(r_2);
    const Vector3 line = body_2.p_WB - body_1.p_WB;
    const PairKinematics at = pair.Compute(body_1, body_2);
    const double size = r_1 + r_2 + line.norm();
    EXPECT_NEAR(at.gap, line.norm() - r_1 - r_2, 16 * kEpsilon * size);
    EXPECT_TRUE(MatrixNear(at.normal, -line.normalized(), 16 * kEpsilon));
    const Vector3 turn = (body_2.v_WB - body_1.v_WB) / line.norm();
    EXPECT_TRUE(MatrixNear(-at.normal_dot, turn - turn.dot(at.normal) * at.normal,
                           64 * kEpsilon * size / line.norm() * turn.norm()));
  }
}

// Exchanging the bodies turns the normal round and leaves everything else.
TEST(SurfacePairTest, ExchangeOfTheBodies) {
  ExtremeContacts extremes(206);
  for (int i = 0; i < 4000; ++i) {
    const Two bodies = DrawEllipsoids(&extremes);
    const PlacedSurface one{bodies.surface_1, Vector3::Zero(), Matrix3::Identity()};
    const PlacedSurface two{bodies.surface_2, Vector3::Zero(), Matrix3::Identity()};
    FrameMotion body_1 = extremes.Motion(bodies.size()), body_2 = extremes.Motion(bodies.size());
    body_1.p_WB = bodies.p_1, body_2.p_WB = bodies.p_2;
    SurfacePair pair(one, two), exchanged(two, one);
    const PairKinematics at = pair.Compute(body_1, body_2);
    if (pair.separation().state != State::kSeparated) continue;
    const PairKinematics other = exchanged.Compute(body_2, body_1);
    const double S = bodies.surface_1.SupportHessian(bodies.R_1.transpose() * pair.separation().nu).norm();
    EXPECT_NEAR(other.gap, at.gap, 64 * kEpsilon * bodies.size());
    EXPECT_TRUE(MatrixNear(other.p_1, at.p_2, 1e-9 * (bodies.size() + S)));
    EXPECT_NEAR(other.gap_rate, at.gap_rate, 1e-9 * (at.slip.norm() + std::abs(at.gap_rate)));
    EXPECT_NEAR(at.gap_rate, at.normal.dot(at.slip), 64 * kEpsilon * at.slip.norm());
  }
}

// A body pushed through another in small steps stays on its branch and meets the same distance on the way back.
TEST(SurfacePairTest, FollowsItsBranchWhileOverlapping) {
  const PlacedSurface one{Ellipsoid({1, 0.8, 0.3}), Vector3::Zero(), Matrix3::Identity()};
  const PlacedSurface two{Ellipsoid({0.5, 0.6, 0.4}), Vector3::Zero(), ExtremeContacts::Turn({0.4, 0.1, 0.9})};
  SurfacePair pair(one, two);
  FrameMotion body_1, body_2;
  double last = 0;
  for (int step = 0; step <= 60; ++step) {
    body_2.p_WB = Vector3(0.1, 0.05, 1.0 - 0.01 * step);
    const PairKinematics at = pair.Compute(body_1, body_2);
    ASSERT_TRUE(pair.separation().converged);
    EXPECT_LT(pair.separation().iterations, step == 0 ? 20 : 7);
    EXPECT_GT(-at.normal.z(), 0.8);  // ν keeps pointing up, from one to two
    EXPECT_NEAR(at.gap, step == 0 ? at.gap : last + 0.01 * at.normal.z(), 1e-3);
    last = at.gap;
  }
  EXPECT_EQ(pair.separation().state, State::kOverlap);
  // Thrown to the other side, the old branch is left.
  body_2.p_WB = Vector3(0, 0, -2);
  const PairKinematics parted = pair.Compute(body_1, body_2);
  EXPECT_EQ(pair.separation().state, State::kSeparated);
  EXPECT_GT(parted.gap, 1);
  pair.Restart();
  EXPECT_NEAR(pair.Compute(body_1, body_2).gap, parted.gap, 1e-14);
}

TEST(SurfacePairTest, VelocitiesAndAccelerationsAreDerivativesAlongAMotion) {
  SeededRandom random(208);
  const PlacedSurface one{Ellipsoid({0.8, 1.2, 0.5}), {0.1, -0.2, 0.3}, ExtremeContacts::Turn({0.1, 0.7, -0.3})};
  const Surface rounded = Surface(Ellipsoid({0.5, 0.6, 0.7})).Rounded(0.2);
  const PlacedSurface two{rounded, {0, 0.2, 0}, ExtremeContacts::Turn({1, 0, 0})};
  for (const double apart : {3.0, 1.2}) {
    FrameMotion start[2];
    for (FrameMotion& body : start) {
      body = {ExtremeContacts::Turn(2 * random.Unit()),
              random.Vector(-0.1, 0.1),
              random.Vector(-1, 1),
              random.Vector(-1, 1),
              random.Vector(-1, 1),
              random.Vector(-1, 1)};
    }
    start[1].p_WB.y() += apart;
    SurfacePair pair(one, two);
    const auto at = [&](double t) {
      FrameMotion moved[2];
      for (int i = 0; i < 2; ++i) {
        moved[i].R_WB = ExtremeContacts::Turn(start[i].w_WB * t + start[i].alpha_WB * (t * t / 2)) * start[i].R_WB;
        moved[i].p_WB = start[i].p_WB + start[i].v_WB * t + start[i].a_WB * (t * t / 2);
      }
      return pair.Compute(moved[0], moved[1]);
    };
    const PairKinematics now = pair.Compute(start[0], start[1]);
    ASSERT_EQ(now.gap > 0, apart > 2);
    const auto stack = [&](double t) {
      const PairKinematics moved = at(t);
      Eigen::Matrix<double, 10, 1> result;
      result << moved.p_1, moved.p_2, moved.normal, moved.gap;
      return result;
    };
    Eigen::Matrix<double, 10, 1> expected;
    expected << now.p_dot_1, now.p_dot_2, now.normal_dot, now.gap_rate;
    EXPECT_TRUE(MatrixNear(HighOrderDifference(stack, 0.003), expected, 1e-9 * (1 + expected.norm())));
    EXPECT_NEAR(HighOrderSecondDifference(stack, 0.003)(9), now.gap_acceleration,
                1e-7 * (1 + std::abs(now.gap_acceleration)));
    EXPECT_GT(now.drift.norm(), 0.1);
  }
}

TEST(SurfacePairTest, SeparatingPlaneDecides) {
  ExtremeContacts extremes(209);
  for (int i = 0; i < 2000; ++i) {
    const Two bodies = DrawEllipsoids(&extremes);
    const SeparatingPlane plane = FindSeparatingPlane(bodies.one(), bodies.two());
    if (plane.state == SeparatingPlane::State::kFound) {
      EXPECT_GT(G(bodies.one(), bodies.two(), plane.nu), 0);
    } else {
      EXPECT_EQ(plane.state, SeparatingPlane::State::kNone);
      for (int n = 0; n < 50; ++n) {
        EXPECT_LT(G(bodies.one(), bodies.two(), extremes.random().Unit()), 1e-14 * bodies.size());
      }
    }
  }
}

}  // namespace
}  // namespace rollgait
