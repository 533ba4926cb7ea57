// First and second derivatives of velocities, slip, drift and the gap's rates against differences of order 8 of
// PairKinematics itself, and against second derivations: the geometric part of γ in body axes, spheres in closed form,
// a plane as a very large sphere.
#include "core/contact/pair_hessians.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/multibody/spatial.h"
#include "tests/support/displaced_frames.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;
using Stack = Eigen::Matrix<double, 27, 1>;

Stack Stacked(const PairKinematics& pair) {
  Stack stack;
  stack << pair.normal, pair.p_1, pair.p_2, pair.normal_dot, pair.p_dot_1, pair.p_dot_2, pair.slip, pair.drift,
      pair.gap, pair.gap_rate, pair.gap_acceleration;
  return stack;
}

Stack First(const PairHessians& at, const Vector24& u) {
  Stack stack;
  stack << at.NormalDerivative() * u, at.Point1Derivative() * u, at.Point2Derivative() * u,
      at.NormalRateDerivative() * u, at.PointRate1Derivative() * u, at.PointRate2Derivative() * u,
      at.SlipDerivative() * u, at.DriftDerivative() * u, at.GapDerivative() * u, at.GapRateDerivative() * u,
      at.GapAccelerationDerivative() * u;
  return stack;
}

Stack Second(const PairHessians& at, const Vector24& u) {
  Stack stack;
  for (int i = 0; i < 3; ++i) {
    const Vector3 y = Vector3::Unit(i);
    const Matrix24 hessians[] = {at.Normal(y),     at.Point1(y),     at.Point2(y), at.NormalRate(y),
                                 at.PointRate1(y), at.PointRate2(y), at.Slip(y),   at.Drift(y)};
    for (int k = 0; k < 8; ++k) stack[3 * k + i] = u.dot(hessians[k] * u);
  }
  stack[24] = u.dot(at.Gap() * u);
  stack[25] = u.dot(at.GapRate() * u);
  stack[26] = u.dot(at.GapAcceleration() * u);
  return stack;
}

void SetMotion(SeededRandom* random, FrameMotion* body) {
  for (Vector3* u : {&body->w_WB, &body->v_WB, &body->alpha_WB, &body->a_WB}) *u = random->Vector(-1, 1);
}

// The frames displaced along (ζ, ξ).
FrameMotion Moved(const FrameMotion& body, const Vector24& z, int number) {
  FrameMotion moved = Displaced(body, z.segment<3>(6 * number), z.segment<3>(6 * number + 3));
  moved.v_WB += z.segment<3>(12 + 6 * number);
  moved.w_WB += z.segment<3>(15 + 6 * number);
  return moved;
}

// As in pair_derivatives_test, with one more derivative of the surface: (0.03)⁸ · 30 and more of the value.
constexpr double kStep = 0.0015, kFirstTolerance = 1e-9, kSecondTolerance = 3e-7;

template <typename Evaluate>
void CheckAgainstDifferences(const Evaluate& evaluate, const PairHessians& at, SeededRandom* random) {
  ASSERT_TRUE(at.exist());
  for (int i = 0; i < 8; ++i) {
    const Vector24 u = random->VectorOf(24, -0.5, 0.5);
    const auto along = [&](double t) { return Stacked(evaluate(Vector24(t * u))); };
    const Stack first = First(at, u), second = Second(at, u);
    EXPECT_TRUE(MatrixNear(HighOrderDifference(along, kStep), first, kFirstTolerance * (1 + first.norm())));
    EXPECT_TRUE(MatrixNear(HighOrderSecondDifference(along, kStep), second, kSecondTolerance * (1 + second.norm())));
    for (int k = 9; k < 27; ++k) EXPECT_GT(std::abs(second[k]), 1e-5) << k;
  }
  const Matrix24 drift = at.Drift({0.3, 0.5, -0.7});
  EXPECT_EQ(drift, drift.transpose());
}

TEST(PairHessiansTest, PlanesAgreeWithDifferences) {
  SeededRandom random(61);
  for (const Surface& surface : SmoothBodies()) {
    const PlacedSurface placed{surface, {0.1, 0.2, -0.1}, ExtremeContacts::Turn({0.3, -0.2, 0.5})};
    const PlacedPlane plane{{0.3, 0.1, -0.2}, random.Unit()};
    FrameMotion body = RandomFrame(&random, {0, 0, 2}), ground = RandomFrame(&random, {0.3, 0, 0});
    SetMotion(&random, &body);
    SetMotion(&random, &ground);
    const auto evaluate = [&](const Vector24& z) {
      return ComputePlaneContact(placed, Moved(body, z, 0), plane, Moved(ground, z, 1));
    };
    CheckAgainstDifferences(evaluate, PairHessians::OnPlane(placed, body, plane, ground), &random);
  }
}

TEST(PairHessiansTest, SurfacesAgreeWithDifferences) {
  SeededRandom random(67);
  for (const Surface& first : SmoothBodies()) {
    for (const double distance : {3.0, 0.9}) {  // apart, and overlapping
      TwoBodies at(first, distance, &random);
      SetMotion(&random, &at.body_1);
      SetMotion(&random, &at.body_2);
      SurfacePair pair(at.one, at.two);
      const auto evaluate = [&](const Vector24& z) {
        pair.StartFrom(at.separation.nu);
        return pair.Compute(Moved(at.body_1, z, 0), Moved(at.body_2, z, 1));
      };
      CheckAgainstDifferences(evaluate, PairHessians::OfSurfaces(at.one, at.body_1, at.two, at.body_2, at.separation),
                              &random);
    }
  }
}

// A fixed plane, accelerations zero: y · γ = y_b · b(ν, ω_b),  b = ω × (ω × x + S (ν × ω)), all in body axes, where
// turning the body by exp(θ) turns y, n and ω by exp(−θ). Source: contact-math 6, with T and Q by their own formulas.
TEST(PairHessiansTest, DriftOnAFixedPlaneIsThatOfBodyAxes) {
  SeededRandom random(71);
  for (int i = 0; i < 20; ++i) {
    const Surface surface(Ellipsoid(random.Vector(0.3, 1)));
    FrameMotion body = RandomFrame(&random, {0, 0, 1});
    body.w_WB = random.Vector(-2, 2);
    const Vector3 y_W = random.Vector(-1, 1);
    const PlacedSurface placed{surface, Vector3::Zero(), Matrix3::Identity()};
    const Matrix24 drift = PairHessians::OnPlane(placed, body, {}, FrameMotion{}).Drift(y_W);

    const Matrix3 to_body = body.R_WB.transpose();
    const Vector3 nu = -to_body.col(2), omega = to_body * body.w_WB, y = to_body * y_W;
    const Matrix3 S = surface.SupportHessian(nu);
    const auto T = [&](const Vector3& u) { return surface.SupportThird(nu, u); };
    const Vector3 inner = omega.cross(surface.SupportPoint(nu)) + S * nu.cross(omega);
    for (int pass = 0; pass < 12; ++pass) {
      const Vector3 theta_W = random.Vector(-1, 1), delta_W = random.Vector(-1, 1);
      const Vector3 theta = to_body * theta_W;
      const auto turned = [&](const Vector3& u) { return Vector3(-theta.cross(u)); };
      // First and second changes of ν, ω and y along exp(−θ), ω with δ on top of it.
      const Vector3 nu_1 = turned(nu), nu_2 = turned(nu_1), y_1 = turned(y), y_2 = turned(y_1);
      const Vector3 delta = to_body * delta_W, omega_1 = turned(omega) + delta;
      const Vector3 omega_2 = turned(turned(omega)) + 2 * turned(delta);
      // x, S (ν × ω) and their changes.
      const Vector3 x_1 = S * nu_1, x_2 = S * nu_2 + T(nu_1) * nu_1, c = nu.cross(omega);
      const Vector3 c_1 = nu_1.cross(omega) + nu.cross(omega_1);
      const Vector3 c_2 = nu_2.cross(omega) + 2 * nu_1.cross(omega_1) + nu.cross(omega_2);
      const Matrix3 S_1 = T(nu_1), S_2 = T(nu_2) + surface.SupportFourth(nu, nu_1, nu_1);
      const Vector3 x = surface.SupportPoint(nu);
      const Vector3 inner_1 = omega_1.cross(x) + omega.cross(x_1) + S_1 * c + S * c_1;
      const Vector3 inner_2 =
          omega_2.cross(x) + 2 * omega_1.cross(x_1) + omega.cross(x_2) + S_2 * c + 2 * S_1 * c_1 + S * c_2;
      const Vector3 b = omega.cross(inner), b_1 = omega_1.cross(inner) + omega.cross(inner_1);
      const Vector3 b_2 = omega_2.cross(inner) + 2 * omega_1.cross(inner_1) + omega.cross(inner_2);
      const double expected = y_2.dot(b) + 2 * y_1.dot(b_1) + y.dot(b_2);
      Vector24 u = Vector24::Zero();
      u.segment<3>(3) = theta_W;
      u.segment<3>(15) = delta_W;
      // Rounding of terms that are S and T (up to 40 m here) times ω².
      EXPECT_NEAR(u.dot(drift * u), expected, 1e-11 * (1 + drift.norm()));
    }
  }
}

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;

// Two spheres with their centres at the frames' origins, in long double: ẇ is that of centres and a line between them.
Long SphereDrift(const Vector3& y, double radius_1, double radius_2, const FrameMotion& one, const FrameMotion& two,
                 const Vector24& u, double t) {
  const auto at = [&](const Vector3& value, int index) {
    return Long3(value.cast<Long>() + static_cast<Long>(t) * u.segment<3>(index).cast<Long>());
  };
  const Long3 line = at(one.p_WB, 0) - at(two.p_WB, 6), n = line.normalized();
  const Long3 v = at(one.v_WB, 12) - at(two.v_WB, 18), w_1 = at(one.w_WB, 15), w_2 = at(two.w_WB, 21);
  const Long3 n_dot = (v - n * n.dot(v)) / line.norm();
  const Long r_1 = radius_1, r_2 = radius_2;
  const Long3 drift = one.a_WB.cast<Long>() - r_1 * (one.alpha_WB.cast<Long>().cross(n) + w_1.cross(n_dot)) -
                      two.a_WB.cast<Long>() - r_2 * (two.alpha_WB.cast<Long>().cross(n) + w_2.cross(n_dot));
  return y.cast<Long>().dot(drift);
}

TEST(PairHessiansTest, SpheresAreClosedForm) {
  SeededRandom random(73);
  for (int i = 0; i < 50; ++i) {
    const double radius_1 = random.Uniform(0.3, 1), radius_2 = random.Uniform(0.3, 1);
    const PlacedSurface one{Sphere(radius_1), Vector3::Zero(), Matrix3::Identity()};
    const PlacedSurface two{Sphere(radius_2), Vector3::Zero(), Matrix3::Identity()};
    FrameMotion body_1 = RandomFrame(&random, {0, 0, 0});
    FrameMotion body_2 = RandomFrame(&random, random.Uniform(1.1, 2) * (radius_1 + radius_2) * random.Unit());
    SetMotion(&random, &body_1);
    SetMotion(&random, &body_2);
    SurfacePair pair(one, two);
    pair.Compute(body_1, body_2);
    const PairHessians at = PairHessians::OfSurfaces(one, body_1, two, body_2, pair.separation());
    const Vector3 y = random.Vector(-1, 1);
    const Matrix24 drift = at.Drift(y);
    for (int pass = 0; pass < 5; ++pass) {
      const Vector24 u = random.VectorOf(24, -1, 1);
      const auto along = [&](double t) {
        return Eigen::Matrix<Long, 1, 1>(SphereDrift(y, radius_1, radius_2, body_1, body_2, u, t));
      };
      // Step 0.004 over lengths of 0.6 and more: (0.04)⁸, and rounding 1e-19 over its square; the rest is double's.
      const double second = static_cast<double>(HighOrderSecondDifference(along, 0.004)(0));
      EXPECT_NEAR(u.dot(drift * u), second, 3e-11 * (1 + drift.norm()));
    }
  }
}

// A fixed plane is a sphere of 10⁷ m within 1e-7, for all that the first body does.
TEST(PairHessiansTest, APlaneIsAVeryLargeSphere) {
  SeededRandom random(79);
  const double radius = 1e7;
  for (int i = 0; i < 20; ++i) {
    const PlacedSurface one{Ellipsoid(random.Vector(0.4, 1)), random.Vector(-0.2, 0.2), Matrix3::Identity()};
    const PlacedSurface two{Sphere(radius), {0, 0, -radius}, Matrix3::Identity()};
    FrameMotion body = RandomFrame(&random, {0, 0, 1.5});
    SetMotion(&random, &body);
    SurfacePair pair(one, two);
    const Vector3 up(0, 0, -1);
    pair.StartFrom(up);
    pair.Compute(body, {});
    const PairHessians large = PairHessians::OfSurfaces(one, body, two, {}, pair.separation());
    const PairHessians plane = PairHessians::OnPlane(one, body, {}, {});
    const Vector3 y = random.Vector(-1, 1);
    const auto own = [](const Matrix24& all) {  // of ζ and ξ of the first body
      Matrix12 block;
      block << all.block<6, 6>(0, 0), all.block<6, 6>(0, 12), all.block<6, 6>(12, 0), all.block<6, 6>(12, 12);
      return block;
    };
    const Matrix12 drift = own(plane.Drift(y)), second = own(plane.GapAcceleration());
    EXPECT_GT(drift.norm(), 0.1);
    EXPECT_TRUE(MatrixNear(own(large.Drift(y)), drift, 1e-5 * (1 + drift.norm())));
    EXPECT_TRUE(MatrixNear(own(large.GapAcceleration()), second, 1e-5 * (1 + second.norm())));
  }
}

// Where the whole pair is, does not matter.
TEST(PairHessiansTest, NothingDependsOnACommonShift) {
  SeededRandom random(83);
  TwoBodies at(Ellipsoid({0.8, 1.2, 0.5}), 3, &random);
  SetMotion(&random, &at.body_1);
  SetMotion(&random, &at.body_2);
  const Matrix24 drift = PairHessians::OfSurfaces(at.one, at.body_1, at.two, at.body_2, at.separation).Drift({1, 2, 3});
  EXPECT_TRUE(MatrixNear(drift.middleCols<3>(0), -drift.middleCols<3>(6), 1e-12 * drift.norm()));
  EXPECT_TRUE(MatrixNear(drift.middleCols<3>(12), -drift.middleCols<3>(18), 1e-12 * drift.norm()));
  EXPECT_GT(drift.middleCols<3>(0).norm(), 0.1);
}

TEST(PairHessiansTest, SaysWhereThereAreNone) {
  // An exponent of 1.4: T exists on a coordinate plane (from 4/3), Q does not (from 3/2).
  const PlacedSurface pinched{Superellipsoid({0.5, 0.4, 0.3}, 1.4, 1.4), Vector3::Zero(), Matrix3::Identity()};
  const PlacedSurface round{Ellipsoid({0.5, 0.4, 0.3}), Vector3::Zero(), Matrix3::Identity()};
  FrameMotion body;
  body.p_WB.z() = 0.3;
  EXPECT_EQ(ComputePlaneDerivatives(pinched, body, {}, {}, 2).order, 2);
  EXPECT_FALSE(PairHessians::OnPlane(pinched, body, {}, {}).exist());
  EXPECT_TRUE(PairHessians::OnPlane(round, body, {}, {}).exist());
}

}  // namespace
}  // namespace rollgait
